"""How `check-answers` judges the 391 sheets of benchmarks/sheets, of which it is known what was done on each.

Method. A sheet has a mistake in setting the problem up (``mistake``), a slip carried forward (``slip``), random wrong
numbers (``random``), values read from a drawing (``drawn``), figures right within the tolerance (``within``) or right
ones (``true``). ``accept`` has groups of words; a sentence fits if it has all words of a group. A sheet is judged
rightly if a mistake is named or reported as *may be*, a slip is consistent with the student's earlier figures, and no
other sheet is charged with a mistake. Run it from the checkout.

    python -m benchmarks.judged
"""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

import dalembert as da
from dalembert.grading.answer_sheet import read_sheet
from dalembert.grading.mistakes import SolvedProblem

SHEETS = Path(__file__).parent / "sheets"
CHARGED = ("named", "sign", "unit")
RIGHT = {"mistake": "named or may be", "slip": "consistent with earlier figures", "true": "accepted"}


def fits(sentence: str, accept: list[list[str]]) -> bool:
    """True if a sentence has all words of a group."""
    return any(all(word.lower() in sentence.lower() for word in words) for words in accept)


def judged(sheet: dict[str, Any], verdicts: Any) -> tuple[bool, bool, bool]:
    """Judged rightly; charged with a mistake that was not made; the same as *may be*."""
    wrong = [v for v in verdicts if not v.right]
    if sheet["kind"] == "true":
        return not wrong, bool(wrong), False
    charged = [v.mistake for v in wrong if v.kind in CHARGED]
    hinted = [v.mistake for v in wrong if v.kind == "may be" or v.mistake.lower().startswith("may be")]
    named = any(fits(s, sheet["accept"]) for s in charged + hinted)
    own = any("own figure" in v.mistake.lower() for v in verdicts)
    good = {"mistake": named, "slip": own or named}.get(sheet["kind"], not charged)
    false = sheet["kind"] != "within" and any(not fits(s, sheet["accept"]) for s in charged)
    return good, false, any(not fits(s, sheet["accept"]) for s in hinted)


def main() -> None:
    problems: dict[str, SolvedProblem] = {}
    counts: dict[str, Counter[str]] = {}
    for sheet in json.loads((SHEETS / "sheets.json").read_text(encoding="utf-8")):
        name = sheet["model"]
        if name not in problems:
            problems[name] = SolvedProblem(da.load(SHEETS / name))
        answers = read_sheet({"efforts": sheet["efforts"], "reactions": sheet["reactions"]}).answers
        good, false, hint = judged(sheet, problems[name].verdicts(list(answers)))
        counts.setdefault(sheet["kind"], Counter()).update(
            {"all": 1, "good": good, "false": false, "hint": hint}
        )
    print("| sheets | judged rightly | charged with another mistake | another one as *may be* |")
    print("| --- | --- | --- | --- |")
    for kind, n in sorted(counts.items()):
        print(
            f"| {kind} | {RIGHT.get(kind, 'not charged')}: {n['good']} of {n['all']} | {n['false']} | {n['hint']} |"
        )


if __name__ == "__main__":
    main()
