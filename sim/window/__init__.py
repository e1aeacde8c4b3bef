"""The rehearsal window: the virtual client in a real window of GLFW, the game's own library, in real time.

rehearsal.py        what is rehearsed, frame by frame: events -> the client's clock -> the picture; mishaps; the truth
glfw_window.py      the window and its OpenGL context
input_events.py     GLFW's events, for the client, and its keys by the place they lie at
frame_pacer.py      real time as the client's, a frame at a time, and the eye between two ticks
window_picture.py   a frame: the world below (world_scene.py), the GUI above
"""
