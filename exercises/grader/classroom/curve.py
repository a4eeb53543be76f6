"""Expected and got as two lines in one small picture, drawn from numbers alone."""

import math

from exercises.grader.classroom.page import text

WIDTH, HEIGHT, MARGIN = 560, 200, 46
EXPECTED, GOT = "#0072B2", "#D55E00"  # blue and vermilion: apart for colour-blind eyes too
FAR = 4.0  # heights of the expected curve that a wrong one may leave the picture by


def svg(curves, label):
    """SVG of `curves`, (expected, got): columns of [index, number or None]. "" if they cannot be drawn."""
    expected, got = curves
    if not all(_is_column(column) for side in curves for column in side):
        return ""
    low, high = _range(expected)
    seen = _range(got)
    reach = FAR * (high - low)
    low, high = max(min(low, seen[0]), low - reach), min(max(high, seen[1]), high + reach)
    last = max(column[-1][0] for column in expected) or 1

    def x(index):
        return MARGIN + index / last * (WIDTH - MARGIN - 8)

    def y(value):
        return HEIGHT - 24 - (min(max(value, low), high) - low) / (high - low) * (HEIGHT - 40)

    lines = [_line(column, EXPECTED, "", x, y) for column in expected]
    lines += [_line(column, GOT, ' stroke-dasharray="6 4"', x, y) for column in got]
    ticks = "".join(
        f'<text x="{MARGIN - 4}" y="{y(value) + 4:.0f}" text-anchor="end">{value:.3g}</text>'
        for value in (low, high)
    )
    return (
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" role="img" font-size="11" fill="currentColor" '
        f'aria-label="{text(label)}: expected, a full line, and got, a dashed line, over the index">{ticks}'
        f'<path d="M{MARGIN} 10V{HEIGHT - 22}H{WIDTH - 8}" fill="none" stroke="currentColor" '
        'stroke-opacity=".4"/>'
        f'{"".join(lines)}<text x="{MARGIN}" y="{HEIGHT - 6}">index 0</text>'
        f'<text x="{WIDTH - 8}" y="{HEIGHT - 6}" text-anchor="end">{last}</text>'
        f'<text x="{WIDTH // 2}" y="{HEIGHT - 6}" text-anchor="middle">'
        f'<tspan fill="{EXPECTED}">—— expected</tspan>   <tspan fill="{GOT}">- - - got</tspan></text></svg>'
    )


def _is_column(column):
    return len(column) >= 2 and all(
        type(i) is int and (v is None or type(v) in (int, float) and abs(v) < 1e100) for i, v in column
    )


def _range(columns):
    values = [value for column in columns for _, value in column if value is not None] or [0.0]
    low, high = min(values), max(values)
    spread = (high - low) or max(abs(high), 1.0)
    return low - 0.05 * spread, high + 0.05 * spread


def _line(column, colour, dash, x, y):
    """One line, broken where there is no finite number."""
    path, pen = [], "M"
    for index, value in column:
        if value is None or not math.isfinite(value):
            pen = "M"
        else:
            path.append(f"{pen}{x(index):.1f} {y(value):.1f}")
            pen = "L"
    return f'<path d="{"".join(path)}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>'
