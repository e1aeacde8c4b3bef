import java.io.*;
import java.net.Socket;
import java.nio.charset.StandardCharsets;
import java.util.*;
import java.util.concurrent.*;
import org.lwjgl.input.*;
import org.lwjgl.opengl.*;

/**
 * A real window of LWJGL 2, made as the game's own is to 1.12, that notes what reaches it and does what it is told.
 *
 * <p>usage: Lwjgl2Window PORT TITLE. It speaks as window_server.py has it. Keys have LWJGL's names, and the cursor's
 * motions are relative; a character is one of its key's own event.
 */
public class Lwjgl2Window {
    private static final List<String> events = new ArrayList<>();
    private static final String END = "end";
    private static boolean hasFocus;

    public static void main(String[] arguments) throws Exception {
        Display.setDisplayMode(new DisplayMode(320, 240));
        Display.setLocation(60, 40);
        Display.setTitle(arguments[1]);
        Display.create();
        Keyboard.create();
        Mouse.create();
        Keyboard.enableRepeatEvents(true);
        try (Socket socket = new Socket("127.0.0.1", Integer.parseInt(arguments[0]))) {
            BlockingQueue<String> told = new LinkedBlockingQueue<>();
            Thread reader = new Thread(() -> read(socket, told));
            reader.setDaemon(true);
            reader.start();
            OutputStream out = socket.getOutputStream();
            while (true) {
                take();
                String line = told.poll(4, TimeUnit.MILLISECONDS);
                if (line == END) break;
                if (line != null) out.write((answer(line) + "\n").getBytes(StandardCharsets.UTF_8));
            }
        }
        Display.destroy();
        System.exit(0);
    }

    private static void read(Socket socket, BlockingQueue<String> told) {
        try (Scanner lines = new Scanner(socket.getInputStream(), StandardCharsets.UTF_8)) {
            while (lines.hasNextLine()) told.add(lines.nextLine());
        } catch (IOException error) {
            // as when it ends
        }
        told.add(END);
    }

    private static String answer(String line) throws Exception {
        switch (line) {
            case "[\"events\"]":
                for (int look = 0; look < 2; look++) take();
                String taken = events.toString();
                events.clear();
                return taken;
            case "[\"state\"]":
                return "{\"has focus\": " + Display.isActive() + "}";
            case "[\"grab cursor\"]":
                Mouse.setGrabbed(true);
                return "true";
            case "[\"free cursor\"]":
                Mouse.setGrabbed(false);
                return "null";
            default: // it can't ask for the focus
                return "null";
        }
    }

    /** Draw, and take the events that have come. */
    private static void take() {
        Display.update();
        if (Display.isActive() != hasFocus) {
            hasFocus = !hasFocus;
            events.add("[\"focus\", " + (hasFocus ? 1 : 0) + "]");
        }
        while (Keyboard.next()) {
            int key = Keyboard.getEventKey();
            int action = Keyboard.getEventKeyState() ? (Keyboard.isRepeatEvent() ? 2 : 1) : 0;
            events.add("[\"key\", \"" + Keyboard.getKeyName(key) + "\", " + key + ", " + action + "]");
            int typed = Keyboard.getEventCharacter();
            if (action > 0 && typed >= ' ' && typed != 127) events.add("[\"char\", " + typed + "]");
        }
        while (Mouse.next()) {
            if (Mouse.getEventDX() != 0 || Mouse.getEventDY() != 0)
                events.add("[\"cursor\", " + Mouse.getEventDX() + ", " + Mouse.getEventDY() + "]");
            if (Mouse.getEventButton() >= 0)
                events.add("[\"button\", " + Mouse.getEventButton() + ", " + (Mouse.getEventButtonState() ? 1 : 0) + "]");
        }
    }
}
