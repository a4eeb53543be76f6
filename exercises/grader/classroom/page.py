"""The frame of every page that goes out: one file, no script, nothing fetched, all text escaped."""

import html

from exercises.grader.classroom.files import printable

POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'"
STYLE = """
:root{color-scheme:light dark;--line:#8886;--soft:#8881;--bad:#a63d00}
@media(prefers-color-scheme:dark){:root{--bad:#ff9a5c}}
body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.5rem}h2{font-size:1.15rem;margin:2rem 0 .3rem}
table{border-collapse:collapse;margin:.6rem 0}
td,th{padding:.2rem .8rem .2rem 0;text-align:left;vertical-align:top}
tr+tr>*{border-top:1px solid var(--line)}th{font-weight:600;white-space:nowrap}td.n{text-align:right}
pre{margin:0;white-space:pre-wrap;overflow-wrap:anywhere;font:14px/1.45 ui-monospace,monospace}
section{border-left:4px solid var(--bad);padding-left:1rem}section>h2{color:var(--bad)}
.note{background:var(--soft);padding:.5rem .8rem;border-radius:.3rem}svg{max-width:100%;height:auto}
"""


def text(value, longest=4000):
    """A student's text, or ours, as HTML: no mark-up, no control characters, no end in sight cut short."""
    return html.escape(printable(value, longest), quote=True)


def pre(value):
    return f"<pre>{text(value)}</pre>"


def rows(pairs):
    """A table of names and cells that are HTML already; empty cells leave their row out."""
    lines = "".join(f"<tr><th scope=row>{text(name)}<td>{cell}" for name, cell in pairs if cell)
    return f"<table>{lines}</table>" if lines else ""


def page(title, body):
    """A whole page. `title` is text, `body` HTML."""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
        '<meta name="viewport" content="width=device-width">\n<meta name="referrer" content="no-referrer">\n'
        f"<title>{text(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n{body}\n</body>\n</html>\n"
    )
