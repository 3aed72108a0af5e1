# SPDX-License-Identifier: Apache-2.0
"""Texts for tools/make_docs.py: head comments, formulas and references as HTML."""
import html
import re
import unicodedata

_LABEL = re.compile(r"(?:^|(?<=[.!?] ))((?:Formula|Sources?|Known exactly|Known|Limits)\b[^:.]{0,40}):\s")
_SIGNS = (("&lt;=", "≤"), ("&gt;=", "≥"), (" != ", " ≠ "))
_ACCENTS = {"'": "\u0301", "`": "\u0300", "^": "\u0302", '"': "\u0308", "~": "\u0303", "=": "\u0304", "v": "\u030c"}


def member_comment(folder, name):
    """The file of a member of a table and the lines of its comment: the file's head, or of a row the one that begins with
    "name: "."""
    file = folder / f"{name.replace('-', '_')}.c"
    if file.exists():
        return file, head_comment(file)
    for file in sorted(folder.glob("*.c")):
        for found in re.finditer(rf"/\*\s(?: \* )?({re.escape(name)}: .*?)\*/", file.read_text(encoding="utf-8"), re.S):
            return file, _lines(found[1])
    raise SystemExit(f"{folder}: no file and no row {name}")


def head_comment(path):
    """The lines of the comment that a source file begins with, after its licence."""
    text = path.read_text(encoding="utf-8")
    for found in re.finditer(r"/\*(.*?)\*/", text, re.S):
        if "SPDX" not in found[1]:
            break
    else:
        raise SystemExit(f"{path}: it has no head comment")
    if text[: found.start()].replace("/* SPDX-License-Identifier: Apache-2.0 */", "").strip():
        raise SystemExit(f"{path}: its first comment is below code")
    return _lines(found[1])


def _lines(comment):
    """The lines of a comment's text without its stars."""
    lines = [re.sub(r"^ \* ?", "", line).rstrip() for line in comment.splitlines()]
    lines[0] = lines[0].lstrip()
    while lines and not lines[0]:
        del lines[0]
    while lines and not lines[-1]:
        del lines[-1]
    return lines


def formula(text):
    """Plain text with x_k, b^-2, sum_i, pi as HTML."""
    text = html.escape(text, quote=False)
    for sign, better in _SIGNS:
        text = text.replace(sign, better)
    text = re.sub(r"\bsum_", "Σ_", text)
    text = re.sub(r"\bprod_", "∏_", text)
    text = re.sub(r"\bsqrt\s?(?=[\w(])", "√", text)
    for name, letter in (("pi", "π"), ("phi", "φ"), ("psi", "ψ"), ("sigma", "σ")):
        text = re.sub(rf"(?<![\w-]){name}(?=[\W_^]|$)(?!=)(?!-)", letter, text)
    text = re.sub(r"(?<![\w.])([A-Za-zΣ∏φψσ])_(\w{1,3}\b|\([^()]*\))", lambda m: f"{m[1]}<sub>{_bare(m[2])}</sub>", text)
    return re.sub(r"\^(-\w+/\d+|-?\w+(?:\.\d+)?|\((?:[^()]|\([^()]*\))*\))", lambda m: f"<sup>{_bare(m[1])}</sup>", text)


def _bare(text):
    return text[1:-1] if text.startswith("(") and text.endswith(")") else text


def comment_html(lines, name):
    """A head comment: paragraphs, formulas that are set apart, and the labels (Source, Known exactly, ..) in bold."""
    lines = [re.sub(rf"^{re.escape(name)}: *", "", lines[0])] + lines[1:]
    if lines[0][:1].islower():
        lines[0] = lines[0][0].upper() + lines[0][1:]
    parts, prose = [], []

    def end_prose():
        if prose:
            text = " ".join(prose)
            cuts = [0] + [m.start() for m in _LABEL.finditer(text) if m.start()] + [len(text)]
            for begin, end in zip(cuts, cuts[1:]):
                label = _LABEL.match(text[begin:end])
                rest = text[begin + label.end() : end] if label else text[begin:end]
                rest = rest[:1].upper() + rest[1:] if label and rest[1:2].islower() else rest
                parts.append("<p>" + (f"<b>{html.escape(label[1])}.</b> " if label else "") + formula(rest.strip()) + "</p>")
            prose.clear()

    apart = []
    for line in lines + [""]:
        if line.startswith("  "):
            end_prose()
            apart.append(line)
            continue
        if apart:
            margin = min(len(a) - len(a.lstrip()) for a in apart)
            parts.append("<pre class='formula'>" + "\n".join(formula(a[margin:]) for a in apart) + "</pre>")
            apart = []
        if line:
            prose.append(line)
        else:
            end_prose()
    return "\n".join(parts)


def _plain(text):
    """BibTeX's accents, dashes and braces as plain text."""
    text = text.replace(r"{\'i}", "í").replace(r"\ss", "ß").replace(r"\o", "ø").replace("$L_2$", "L2").replace("$", "")
    text = re.sub(r"\\([v])\{?([A-Za-z])\}?", lambda m: unicodedata.normalize("NFC", m[2] + _ACCENTS[m[1]]), text)
    text = re.sub(r"\\(['`^\"~=])\{?\\?([A-Za-z])\}?", lambda m: unicodedata.normalize("NFC", m[2] + _ACCENTS[m[1]]), text)
    return re.sub(r"\s+", " ", text.replace("---", "—").replace("--", "–").replace("{", "").replace("}", "").replace("\\", ""))


def references(path):
    """docs/references.bib as {key: {field: text}}, in its order."""
    text, found = path.read_text(encoding="utf-8"), {}
    for start in re.finditer(r"^@(\w+)\{(\w+),", text, re.M):
        at, depth = start.end(), 1
        while depth:
            depth += {"{": 1, "}": -1}.get(text[at], 0)
            at += 1
        body, fields = text[start.end() : at - 1], {}
        for field in re.finditer(r"(\w+)\s*=\s*\{", body):
            end, depth = field.end(), 1
            while depth:
                depth += {"{": 1, "}": -1}.get(body[end], 0)
                end += 1
            fields.setdefault(field[1], _plain(body[field.end() : end - 1]))
        if not {"author", "title", "year"} <= fields.keys():
            raise SystemExit(f"{path}: {start[2]} lacks its author, title or year")
        found[start[2]] = fields
    return found


def short_reference(fields):
    """As in "Cook et al. 1984"."""
    names = [name.split(",")[0] if "," in name else name.split()[-1] for name in fields["author"].split(" and ")]
    text = names[0] if len(names) == 1 else " & ".join(names) if len(names) == 2 else f"{names[0]} et al."
    return f"{text} {fields['year']}"


def long_reference(fields):
    """The whole reference as HTML."""
    names = fields["author"].split(" and ")
    authors = names[0] if len(names) == 1 else ", ".join(names[:-1]) + " & " + names[-1]
    where = [fields[f] for f in ("journal", "booktitle", "school", "publisher", "institution", "howpublished") if f in fields]
    if "volume" in fields:
        where.append(f"vol. {fields['volume']}" + (f" ({fields['number']})" if "number" in fields else ""))
    where += [f"pp. {fields['pages']}"] if "pages" in fields else []
    where += [fields["note"]] if "note" in fields else []
    tail = "; ".join(html.escape(w) for w in where)
    link = f" <a href='{html.escape(fields['url'])}'>{html.escape(fields['url'])}</a>" if "url" in fields else ""
    return f"{html.escape(authors)} ({fields['year']}): <i>{html.escape(fields['title'])}</i>. {tail}.{link}"
