"""A made-up ablation: two parts of live and one of tuned, on two scenarios."""

from mc_nested.report.ablation_results import Ablation, AblationPart, AblationRow

PLAYED: dict[str, list[int | None]] = {
    "whole": [5, 7, 6, 9],
    "no | hope": [None, None, 20, None],
    "old": [30, 30, 100, 200],
}


def made_ablation() -> Ablation:
    parts = [
        AblationPart("whole", "live", "", 200),
        AblationPart("no | hope", "live", "nothing is imagined to pay", 200),
        AblationPart("old", "tuned", "model-free", 3000),
    ]
    rows = [
        AblationRow(part.name, part.base, scenario, trial, 21.0, 21.0 if played else 14.0, played, 1000 * trial)
        for part in parts
        for scenario in ("line", "zig|zag")
        for trial, played in enumerate(PLAYED[part.name])
    ]
    return Ablation(4, 0, {"line": 21.0, "zig|zag": 21.0}, parts, rows)
