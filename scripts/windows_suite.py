"""What pytest runs under Wine: the unit tests of what meets the system. Standard library only.

What decides by its arguments alone, such as the rules of the arena, the reading of pictures and the simulator, does the
same on every system: a second run of some 2,500 such tests took 20 minutes, and never found anything that the first
hadn't. What differs is what is found by asking the system: its devices and windows, threads, clocks and processes,
folders and files with their names, locks, encodings and ends of lines, and the arithmetic that is compiled for it.
"""

WHERE_WINDOWS_DIFFERS = {
    "tests/live/desktop": "windows, pictures, keys, the mouse, the clipboard and the clock, by Windows' own functions",
    "tests/live/input": "threads that release keys, and handlers of signals",
    "tests/live/test_devices_contract.py": "the devices as a whole",
    "tests/live/test_connection.py": "devices that are opened and released together",
    "tests/live/test_session.py": "devices that are opened and released together, and what a killed session leaves",
    "tests/live/profile": "profiles: found in a folder of the system's, written in one step, with its names of keys",
    "tests/live/recording": "recordings: written by a thread while a game is played, cut and read, after a kill, too",
    "tests/live/menus/test_reset.py": "a world's folder, copied and put back",
    "tests/live/menus/test_click_points.py": "a profile's pictures, by their names",
    "tests/live/vision/test_font.py": "fonts in jars and folders",
    "tests/live/vision/test_chat_region.py": "pictures that are kept as files",
    "tests/live/vision/test_read_pictures.py": "pictures that are read from files",
    "tests/calibration/doctor": "what the doctor asks the system: windows, keys, the clipboard, processes, files",
    "tests/calibration/font": "fonts, looked for where a system has its games",
    "tests/calibration/installation": "the game's folders, its processes and its options' file",
    "tests/calibration/report": "a report's file, and the names of this computer that it must not show",
    "tests/calibration/arena/test_undo.py": "a note in a file, written before anything is built",
    "tests/calibration/test_profiles.py": "profiles in files",
    "tests/calibration/test_step_profile.py": "profiles and pictures in files, and files that can't be written",
    "tests/view": "the view: a console's streams, keys and letters, and files that two programs share",
    "tests/sim/window": "the rehearsal window's keys, time and truth file",
    "tests/sim/client/game/test_realm.py": "a world's folder, which the client keeps as the game does",
    "tests/sim/client/test_world_reset.py": "a world's folder, copied and put back while its game runs",
    "tests/arena/test_scenario_file.py": "designs in files, by their paths and encodings",
    "tests/arena/test_corpus_file.py": "designs in files, by their paths and encodings",
    "tests/learn/runs/test_run_folder.py": "a run's files",
    "tests/workers/test_process.py": "processes: their start, their pipes and their end",
    "tests/workers/test_processes.py": "processes that end with their parent, and after a kill",
    "tests/cli/test_interrupt.py": "Ctrl+C",
    "tests/cli/test_output_folder.py": "folders' names",
    "tests/cli/test_rehearse.py": "one rehearsal at a time, by a lock in a folder of the system's",
    "tests/test_atomic_file.py": "files that are replaced in one step",
    "tests/test_file_lock.py": "locks, which Windows has of its own",
    "tests/test_toml_file.py": "files' encodings and ends of lines",
    "tests/test_other_processors.py": "a training's bytes, which do not differ",
}
"""Folders and files of tests, and what of them Windows does in its own way."""
