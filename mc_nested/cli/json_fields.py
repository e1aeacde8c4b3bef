"""What each verb prints with --json: the fields of its object, which its --help lists and scripts may rely on.

A field keeps its name and meaning; new ones may come. Paths are text, times seconds, sizes bytes; null is unknown.
"""

from collections.abc import Mapping

_RUN = {
    "folder": "the run's folder",
    "verb": "the command that made it",
    "state": "finished, can be resumed, in use or damaged",
    "why": "what is damaged, or which process uses it",
    "designs": "names of what is built",
    "agents": "names of who learns",
    "presets": "names of the hyper-parameters",
    "trials": "trainings of each agent on each design",
    "episodes_done": "of all trials; an experiment counts finished jobs",
    "episodes": "how many there will be at most",
    "score": "mean of the final scores",
    "optimum": "the highest score possible",
    "size": "bytes of all its files",
    "begun": "local time",
}

_PROFILE = {
    "name": "its name",
    "file": "its file",
    "is_damaged": "whether it can't be read",
    "fits": "whether it fits the open window and its font is there",
    "why": "what doesn't fit, or is damaged or unknown",
    "version": "of Minecraft",
    "window": "width and height in pixels",
    "gui_scale": "screen pixels to a dot of the menus' and the chat's font",
    "debug_scale": "screen pixels to a dot of the debug screen's font",
    "arena_size": "cells along each side",
    "date": "day of the calibration",
}

_STUDY = {"folder": "its folder", "files": "what was written, by what it is"}

JSON_FIELDS: Mapping[str, Mapping[str, str]] = {
    "train": {
        "folder": "the run's folder",
        "scenario": "the design's name",
        "agent": "who learnt",
        "preset": "the hyper-parameters' name or file",
        "backend": "sim, virtual or live",
        "trials": "independent trainings",
        "seed": "of all random numbers",
        "episodes": "a trial's, at most",
        "optimum": "the highest score possible",
        "final_scores": "of each trial's policy, played greedily",
        "episodes_to_optimum": "training episodes until each trial was at the optimum",
        "played_to_optimum": "episodes and steps until then, greedy ones too",
        "episodes_done": "of each trial",
        "env_steps": "of training episodes",
        "evaluation_steps": "of greedy episodes",
        "updates": "of all networks",
        "wall_s": "seconds that it took",
        "networks": "of a trial",
        "parameters": "of a trial's networks",
        "live": "of a live game, or of virtual ones: what playing took",
    },
    "cooperate": {
        "folder": "the run's folder",
        "scenario": "the design's name",
        "builders": "in one arena",
        "networks_kind": "shared, own or single",
        "starts": "the builders' cells at the start",
        "preset": "the hyper-parameters' name or file",
        "trials": "independent trainings",
        "seed": "of all random numbers",
        "episodes": "a trial's",
        "optimum": "the highest score possible",
        "final_scores": "the team's, of each trial's policy, played greedily",
        "episodes_to_optimum": "training episodes until each trial was at the optimum",
        "episodes_done": "of each trial",
        "env_ticks": "of training episodes: in a tick every builder acts once",
        "evaluation_ticks": "of greedy episodes",
        "updates": "of all networks",
        "wall_s": "seconds that it took",
        "networks": "of a trial",
        "parameters": "of a trial's networks",
    },
    "reproduce": {
        **_STUDY,
        "claims": "letter, claim and verdict of each; of --robustness also choices, each with its verdict; of --beyond "
        "also trials, that would decide it, null of more than 1,000 or of what is counted",
    },
    "study reproduce": {**_STUDY, "claims": "letter, claim and verdict of each"},
    "study robustness": {**_STUDY, "claims": "letter, claim, verdict of each, and choices, each with its verdict"},
    "study beyond": {
        **_STUDY,
        "claims": "letter, claim and verdict of each, and trials, that would decide it, null of more than 1,000 or of "
        "what is counted",
    },
    "study sweep": _STUDY,
    "study ablation": _STUDY,
    "study benchmark": {**_STUDY, "measures": "of each contestant: trials, solved, and its episodes to the optimum"},
    "evaluate": {
        "folder": "the run's folder",
        "scenario": "the design's name",
        "optimum": "the highest score possible",
        "scores": "of each trial",
        "materials": "that each trial chose",
        "steps": "that each trial took",
    },
    "play": {
        "folder": "the run's folder",
        "trial": "which one played",
        "scenario": "the design's name",
        "score": "of the episode",
        "optimum": "the highest score possible",
        "material": "that was chosen",
        "steps": "of the episode",
        "screenshots": "their folder",
        "film": "its file",
    },
    "scenarios": {
        "scenarios": "of each: name, size, blocks, materials, optimum, fewest_steps (is_exact: by search), "
        "builder_steps, step_limit, parts (cells as rows, worth by material), choose_every (None: once a part) and "
        "the design as rows, the far edge first",
    },
    "read": {
        "file": "the picture",
        "xyz": "position of the feet",
        "yaw": "degrees",
        "pitch": "degrees",
        "target": "id and pos of the block that is looked at",
        "problem": "why it can't be read",
    },
    "doctor": {"checks": "of each: name, status (pass, warn, fail or skip), detail, and the fix"},
    "calibrate all": {
        "profile": "the profile's file",
        "seconds": "that the steps took",
        "steps": "of each: its name, what it found as lines, and on how many samples",
        "left_out": "steps that failed, with the reason",
        "report": "the report's file",
    },
    "build": {
        "scenario": "the design's name",
        "blocks": "of the design",
        "built": "of them, as seen",
        "material": "what it is built of",
        "steps": "that it took",
        "film": "its file",
    },
    "recordings list": {"folder": "where they are kept", "recordings": "for each, the fields of recordings verify"},
    "recordings verify": {
        "recording": "its folder or file",
        "what": "what was recorded, as build-house",
        "version": "of mc-nested that wrote it",
        "began": "local time",
        "seconds": "its length",
        "calls": "of devices, screen and journal",
        "actions": "in it",
        "pictures": "in it",
        "size": "bytes of all its files",
        "damage": "what of it is lost",
    },
    "replay": {
        "actions": "in the recording",
        "followed": "to their end",
        "readings": "in the recording",
        "read_anew": "whose picture was kept",
        "damaged": "what of the recording is lost",
        "differences": "of each: the action, what differs, then and now",
        "font": "what it was read with",
    },
    "runs list": {"folder": "that was looked at", "runs": "as of runs show, without files"},
    "runs show": {**_RUN, "files": "names of its files"},
    "profiles list": {"folder": "of all profiles", "profiles": "as of profiles show, without files"},
    "profiles show": {**_PROFILE, "files": "all that belong to it"},
}


def epilog_of(verb: str) -> str | None:
    """The last paragraph of a verb's --help; None for one without --json."""
    fields = JSON_FIELDS.get(verb)
    if fields is None:
        return None
    return f"--json prints {'; '.join(f'{name}: {meaning}' for name, meaning in fields.items())}."
