"""A page for each submission: feedback/<student>/<unit>/<unit>.html, where nbgrader puts it."""

from exercises.grader.classroom.curve import svg
from exercises.grader.classroom.files import write
from exercises.grader.classroom.page import page, pre, rows, text
from exercises.grader.classroom.scores import number
from exercises.grader.notebook import page as page_of

IN_WORDS = {
    "ok": "",
    "rejected": "The file could not be taken",
    "timeout": "Your notebook ran out of time",
    "crashed": "Python ended while it answered a check",
    "unsandboxed": "Graded without a sandbox",
    "missing": "Nothing was handed in",
    "grader_error": "The grader itself failed: this is no fault of yours, and there is no grade yet",
}


def write_all(scores, folder):
    """Writes a page for every submission; those of missing ones too, so that everyone finds one."""
    for score in scores:
        one = score.submission
        write(folder / one.student / one.unit / f"{one.unit}.html", of_score(score))


def of_score(score):
    """The page of one submission, as HTML."""
    result, unit = score.result or {}, score.submission.unit
    title = f"Unit {unit.replace('_', ' ')}: feedback"
    parts = [f"<h1>{text(title)}</h1>", _points(score), _status(score, result)]
    if score.manual and score.manual.comment:
        parts.append(f"<h2>From your instructor</h2><div class=note>{pre(score.manual.comment)}</div>")
    parts.append(_overview(result))
    parts.append(_troubles(result))
    failed = [check for check in result.get("checks", ()) if not check["passed"]]
    parts += [_check(check, unit) for check in failed if not check.get("unasked")]
    return page(title, "\n".join(filter(None, parts)))


def _points(score):
    if score.final is None:
        return "<p><b>No grade yet.</b></p>"
    lines = [("checks", f"{score.checks} of {score.most} points")]
    if score.manual and score.manual.points:
        lines.append(("added by your instructor", number(score.manual.points)))
    if score.penalty:
        lines.append(("handed in late", f"−{number(score.penalty)}"))
    return f"<p><b>{number(score.final)} of {score.most} points</b></p>" + (
        rows(lines) if len(lines) > 1 else ""
    )


def _status(score, result):
    words = IN_WORDS[score.status]
    if not words:
        return ""
    reason = result.get("reason", "") if score.status != "grader_error" else ""
    return f"<p class=note><b>{text(words)}.</b> {text(reason)}</p>"


def _overview(result):
    lines = [
        f"<tr><td>{'✓' if check['passed'] else '✗'}<td>{text(check['name'])}<td>{text(check['title'])}"
        f"<td class=n>{check['earned']} of {check['points']}<td>{text(check['source'])}"
        for check in result.get("checks", ())
    ]
    head = (
        "<tr><th scope=col><th scope=col>check<th scope=col>what<th scope=col>points<th scope=col>judged by"
    )
    return f"<table>{head}{''.join(lines)}</table>" if lines else ""


def _troubles(result):
    lines = []
    for cell, title, trouble, skipped in result.get("troubles", ()):
        what = "was left out, but for its imports and definitions" if skipped else "did not run to its end"
        lines.append(f"<li>Code cell {int(cell)} (<code>{text(title)}</code>) {what}: {pre(trouble)}")
    return f"<h2>Cells that did not run</h2><ul>{''.join(lines)}</ul>" if lines else ""


def _check(check, unit):
    """All that is told of one failed check."""
    head = f"<h2>{text(check['name'])}: {check['earned']} of {check['points']} points</h2>"
    count = f"{check['failing']} of {check['cases']} cases fail"
    if check["hidden"]:
        count += ". All cases that you can see pass; here is what can be told of the first that you don't see"
    elif not check["unwritten"]:
        count += "; here is the first"
    picture = svg(check["curves"], f"The answer of {check['name']}") if "curves" in check else ""
    read = f"{page_of(unit)}, section “{check['section']}”"
    told = rows(
        [
            (
                "asked for",
                text(f"{check['title']}: {check['form']}" if check["unwritten"] else check["title"]),
            ),
            ("case", "" if check["unwritten"] else text(check["case"])),
            ("call", pre(check["call"]) if check.get("call") and not check["unwritten"] else ""),
            ("expected", pre(check["expected"]) if check.get("expected") and not check["unwritten"] else ""),
            ("got", pre("\n".join([check["got"], *check.get("lines", ())])) if "got" in check else ""),
            ("", text(check.get("complaint", ""))),
            ("error", text(check.get("error", ""))),
            ("tolerance", text(check.get("tolerance", ""))),
            ("why that tolerance", text(check["why"])),
            ("expected comes from", text(check["source"])),
            ("it printed", pre(check["printed"]) if check.get("printed") else ""),
            ("likely cause", text(check["cause"])),
            ("read", text(read)),
        ]
    )
    return f"<section>{head}<p>{count}.</p>{told}{picture}</section>"
