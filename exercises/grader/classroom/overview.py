"""The instructor's page: how the class did, what it found hard, who wrote what someone else wrote."""

import hashlib
from collections import Counter

from exercises.grader.classroom.files import table, write
from exercises.grader.classroom.page import page, rows, text
from exercises.grader.classroom.scores import number

BARS = 10  # columns of the distribution


def write_all(scores, alike, roster, folder, anonymous=False):
    """overview.html and similar.csv, both in the instructor's folder."""
    name = _names(scores, anonymous)
    units = sorted({score.submission.unit for score in scores})
    body = ["<h1>The class</h1>", _made_with(scores)]
    for unit in units:
        body += _unit(unit, [score for score in scores if score.submission.unit == unit], name)
    body.append(_alike(alike, name))
    write(folder / "overview.html", page("The class", "\n".join(body)))
    lines = [
        [one.unit, f"{share:.2f}", name(one.student), name(other.student)] for share, one, other in alike
    ]
    write(folder / "similar.csv", table(("assignment", "shared", "one", "other"), lines))


def _names(scores, anonymous):
    """The students' names, or numbers in place of them that say nothing of the order of the alphabet."""
    if not anonymous:
        return lambda student: student
    students = {score.submission.student for score in scores}
    order = sorted(students, key=lambda student: hashlib.sha256(student.encode("utf-8", "replace")).digest())
    numbers = {student: f"student {i}" for i, student in enumerate(order, 1)}
    return numbers.__getitem__


def _made_with(scores):
    made = Counter(
        (score.result.get("isolation", ""), *sorted((score.result.get("environment") or {}).items()))
        for score in scores
        if score.result and score.result.get("isolation")
    )
    lines = [
        f"<li>{count} in {'NO SANDBOX' if isolation == 'none' else text(isolation)}, with "
        + text(", ".join(f"{key} {value}" for key, value in packages))
        for (isolation, *packages), count in made.most_common(5)
    ]
    return f"<p>Graded:</p><ul>{''.join(lines)}</ul>" if lines else ""


def _unit(unit, scores, name):
    yield f"<h2>{text(unit)}</h2>"
    counts = Counter(score.status for score in scores)
    yield rows([(status, str(count)) for status, count in counts.most_common()])
    graded = [score for score in scores if score.final is not None and score.status != "missing"]
    if graded:
        points = sorted(float(score.final) for score in graded)
        middle = (points[(len(points) - 1) // 2] + points[len(points) // 2]) / 2
        yield (
            f"<p>Of {graded[0].most} points: mean {sum(points) / len(points):.1f}, median {middle:g}, "
            f"least {points[0]:g}, most {points[-1]:g}.</p>"
        )
        yield _distribution(points, graded[0].most)
        yield _checks(graded)
        yield _mistakes(graded)
    lines = [
        f"<tr><td>{text(name(score.submission.student))}<td>{text(score.status)}"
        f"<td class=n>{number(score.final)}<td>{text((score.result or {}).get('reason', ''))}"
        for score in scores
        if score.status not in ("ok", "unsandboxed", "missing")
    ]
    if lines:
        yield (
            "<h3>To look at</h3><table><tr><th>student<th>status<th>score<th>why"
            + "".join(lines)
            + "</table>"
        )
    yield _hints(scores, name)
    missing = [name(score.submission.student) for score in scores if score.status == "missing"]
    if missing:
        yield f"<p>Missing: {text(', '.join(missing), 20000)}.</p>"


def _hints(scores, name):
    """Notebooks that nbgrader's marks say are of something else: never used for a score."""
    lines = []
    for score in scores:
        result = score.result or {}
        names = {check["name"] for check in result.get("checks", ())}
        odd = [hint for hint in (result.get("fingerprint") or {}).get("hints", ()) if hint not in names]
        if odd:
            lines.append(f"<li>{text(name(score.submission.student))}: {text(', '.join(odd[:5]), 300)}")
    if not lines:
        return ""
    return (
        f"<p>Notebooks with nbgrader's marks of checks that this unit has not:</p><ul>{''.join(lines)}</ul>"
    )


def _distribution(points, most):
    counts = [0] * BARS
    for value in points:
        counts[min(BARS - 1, max(0, int(value / most * BARS)))] += 1
    width, tall = 46, max(counts)
    bars = "".join(
        f'<rect x="{i * width + 4}" y="{110 - 100 * count / tall:.0f}" width="{width - 8}" '
        f'height="{100 * count / tall:.0f}" fill="#0072B2"/>'
        + _label(i * width + width / 2, 106 - 100 * count / tall, str(count or ""))
        + _label(i * width + width / 2, 124, f"{most * i / BARS:g}–")
        for i, count in enumerate(counts)
    )
    return (
        f'<svg viewBox="0 -8 {BARS * width} 138" width="{BARS * width}" role="img" font-size="11" '
        f'fill="currentColor" aria-label="How many reached how many points">{bars}</svg>'
    )


def _label(x, y, words):
    return f'<text x="{x:.0f}" y="{y:.0f}" text-anchor="middle">{words}</text>'


def _checks(graded):
    failed, points = Counter(), {}
    for score in graded:
        for check in score.result["checks"]:
            points[check["name"]] = check["points"]
            failed[check["name"]] += not check["passed"]
    lines = [
        f"<tr><td>{text(check)}<td class=n>{most}<td class=n>{failed[check]}"
        f"<td class=n>{100 * failed[check] / len(graded):.0f} %"
        for check, most in points.items()
    ]
    return "<h3>Checks</h3><table><tr><th>check<th>points<th>failed by<th>" + "".join(lines) + "</table>"


def _mistakes(graded):
    """The causes that the checks recognised, the most frequent first."""
    causes = Counter(
        (check["name"], check["cause"])
        for score in graded
        for check in score.result["checks"]
        if check.get("cause")
    )
    lines = [
        f"<tr><td class=n>{count}<td>{text(check)}<td>{text(cause)}"
        for (check, cause), count in causes.most_common(25)
    ]
    if not lines:
        return ""
    return (
        "<h3>Mistakes that recur</h3><table><tr><th>how often<th>check<th>likely cause"
        + "".join(lines)
        + "</table>"
    )


def _alike(alike, name):
    if not alike:
        return "<h2>Near-identical code</h2><p>None found.</p>"
    lines = [
        f"<tr><td>{text(one.unit)}<td class=n>{100 * share:.0f} %<td>{text(name(one.student))}"
        f"<td>{text(name(other.student))}"
        for share, one, other in alike
    ]
    return (
        "<h2>Near-identical code</h2><p>Pairs whose code, names and spacing aside and the starter's taken "
        "away, is mostly the same. Short exercises have few right answers, and students may work together: "
        "read both before you think more of it. This list is nowhere but here and in similar.csv.</p>"
        "<table><tr><th>unit<th>shared<th>one<th>other" + "".join(lines) + "</table>"
    )
