"""The rehearsal window: the virtual client in a real window of GLFW, the game's own library, in real time.

rehearsal.py        what is rehearsed, frame by frame: events -> the client's clock -> the picture
glfw_window.py      the window and its OpenGL context
input_events.py     GLFW's events, for the client          places.py  GLFW's keys by the place they lie at
frame_pacer.py      real time as the client's, a frame at a time, and the eye between two ticks
window_picture.py   a frame: the world below (world_scene.py), the GUI above (tiles.py)
mishap_window.py    what goes wrong, done to a real window
truth_file.py       the world as it truly is, for tests
"""
