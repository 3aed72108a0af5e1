# SPDX-License-Identifier: Apache-2.0
"""For tools/make_docs.py: references. Commands are the program's manual pages (roff), C is the comments and declarations of
the public headers, Python is the docstrings and signatures of the package, which is read and not imported."""
import ast
import html
import re

from docs_site import ROOT, table

HEADERS = ("koksma", "sampler", "series", "spectrum", "warp", "verify", "identify", "mask", "maskfile", "keys", "integrate", "estimate", "optimise", "adaptive", "image", "plot", "render", "study", "datasheet", "atlas", "plugin")

# ---- Commands


def _roff(line):
    """A line of text with \\fB and \\fI as HTML."""
    line = html.escape(re.sub(r"\\([-.&'`])", lambda m: "" if m[1] == "&" else m[1], line.replace("\\:", "").replace("\\e", "\\")), quote=False)
    line = re.sub(r"\\fB(.*?)\\f[RP]", r"<b>\1</b>", line)
    return re.sub(r"\\fI(.*?)\\f[RP]", r"<i>\1</i>", line)


def _words(line):
    return re.sub(r'"([^"]*)"', r"\1", line)


def manual_html(roff, commands):
    """A manual page: the sections that koksma manual writes, and their macros."""
    parts, mode, paragraph = [], "", []

    def end():
        if paragraph:
            parts.append(f"<p>{' '.join(paragraph)}</p>" if mode != "dd" else f"<dd>{' '.join(paragraph)}</dd>")
            paragraph.clear()

    def leave():
        nonlocal mode
        end()
        parts.append({"dd": "</dl>", "dt": "</dl>", "pre": "</pre>"}.get(mode, ""))
        mode = ""

    for line in roff.splitlines():
        macro, _, rest = line.partition(" ") if line.startswith(".") else ("", "", line)
        rest = _words(rest) if macro else rest
        if macro == ".SH":
            leave()
            parts.append(f"<h2>{html.escape(rest.capitalize())}</h2>")
        elif macro in (".TP",):
            end()
            if mode not in ("dd", "dt"):
                parts.append("<dl>")
            mode = "dt"
        elif macro == ".nf":
            leave()
            parts.append("<pre>")
            mode = "pre"
        elif macro in (".fi", ".PP"):
            leave()
        elif macro == ".br":
            end()
        elif macro in (".TH", ".nh", ".ad", ".in"):
            continue
        elif mode == "pre":
            parts.append(_roff(rest) + "\n")
        else:
            text = _roff(rest)
            if macro == ".BR":
                name, _, section = text.partition(" ")
                short = name.replace("koksma-", "")
                link = f"{short}.html" if short in commands else "index.html"
                text = f"<a href='{link}'>{name}</a>{section}"
            elif macro in (".B", ".I"):
                text = f"<b>{text}</b>" if macro == ".B" else f"<i>{text}</i>"
            if mode == "dt":
                parts.append(f"<dt>{text}</dt>")
                mode = "dd"
            else:
                paragraph.append(text)
    leave()
    return "".join(parts)


def commands(site):
    """A page for each command, and one with all of them."""
    rows = []
    for name, what in site.commands.items():
        roff, error = site.program.try_run("manual", name)
        if error:
            raise SystemExit(f"koksma manual {name}: {error}")
        body = re.sub(r"<h2>Name</h2>.*?(?=<h2>)", "", manual_html(roff, site.commands), flags=re.S)
        site.write(f"commands/{name}.html", "command", f"koksma {name}", html.escape(what), body)
        rows.append([f"<a href='{name}.html'>koksma {name}</a>", html.escape(what)])
    roff, _ = site.program.try_run("manual")
    rest = manual_html(roff, site.commands).partition("<h2>Exit status</h2>")
    site.write("commands/index.html", "", "Commands", "<code>koksma COMMAND [OPTION]... [OPERAND]...</code>",
               table(["command", "what it does"], rows) + rest[1] + rest[2])


# ---- C


def _blocks(text):
    """The parts of a header below its head comment: ("section", title) or (comment, declaration)."""
    at = text.index("*/", text.index("*/") + 2) + 2 if text.startswith("/* SPDX") else text.index("*/") + 2
    alone = r"^((?:typedef|KOKSMA_API|KOKSMA_INLINE) [^\n]*\n(?:[^\n]+\n)*)"  # a declaration without a comment
    for found in re.finditer(r"^/\*(.*?)\*/\n((?:[^\n]+\n)*)|" + alone, text[at:], re.M | re.S):
        comment, code = (found[1] or "").strip(), found[2] or found[3] or ""
        section = re.fullmatch(r"-+ (.*?) -+", comment)
        if section:
            yield "section", section[1]
            continue
        body = re.search(r"^\{$", code, re.M)
        if body:  # a function that is defined here: its signature
            code = code[: body.start()].rstrip() + ";\n"
        elif code.count("{") > code.count("}"):  # a struct with empty lines
            end = text.index("\n}", at + found.end())
            code += text[at + found.end() : text.index("\n", end + 1)]
        if code.strip() and not code.startswith("#if") and "__cplusplus" not in code:
            yield comment, re.sub(r"\b(?:KOKSMA_API|KOKSMA_INLINE) ", "", code.rstrip())


def _names(code):
    """What a declaration declares."""
    names = re.findall(r"^\} (\w+);", code, re.M) + re.findall(r"^typedef .*?\b(koksma_\w+)(?: \*?const)?;", code, re.M)
    names += re.findall(r"^[\w* ]*?\*?\b(koksma_\w+)\((?!\*)", code, re.M) + re.findall(r"^#define (\w+)", code, re.M)
    names += re.findall(r"^typedef (?:struct|enum) (koksma_\w+) \{", code, re.M)
    return list(dict.fromkeys(names))


def _listed(lines):
    """Lines that are set in: "name  what it is" with its lines below is a row of a table, everything else keeps its form."""
    rows = []
    for line in lines:
        row = re.match(r"([\w*,. ]*[\w*]) {2,}(\S.*)$", line)
        if row:
            rows.append([f"<code>{row[1]}</code>", row[2]])
        elif rows and line.startswith("  "):
            rows[-1][1] += " " + line.strip()
        elif line.strip():
            return "<pre>" + "\n".join(lines).rstrip() + "</pre>"
    return table([], rows)


def prose(comment):
    """A comment: paragraphs; lines that are set in keep their form."""
    if not comment:
        return ""
    lines = [re.sub(r"^ \* ?|^ \*$", "", line) for line in comment.splitlines()]
    parts, text, apart = [], [], []
    margin = 3 if not comment.startswith("\n") else 0  # of the lines after the first of a comment that stands beside its stars

    def end():
        if text:
            parts.append(f"<p>{' '.join(text)}</p>".replace(" Errors: ", "</p><p><b>Errors:</b> ").replace("<p>Errors: ", "<p><b>Errors:</b> "))
            text.clear()
        if apart:
            cut = min(len(a) - len(a.lstrip()) for a in apart if a.strip())
            parts.append(_listed([a[cut:] for a in apart]))
            apart.clear()

    for i, line in enumerate(lines):
        line = html.escape(line.rstrip(), quote=False)
        inner = line[margin:] if i and margin and line.startswith(" " * margin) else line
        if not inner.strip():
            if apart and i + 1 < len(lines) and lines[i + 1].startswith(" " * (margin + 2)):
                apart.append("")
            else:
                end()
        elif inner.startswith("  "):
            if text:
                end()
            apart.append(inner)
        else:
            if apart:
                end()
            text.append(inner.strip())
    end()
    return "".join(parts)


def c_reference(site):
    """A page for each public header, and one with all of them and the statuses."""
    read = {name: (ROOT / f"include/koksma/{name}.h").read_text(encoding="utf-8") for name in HEADERS}
    blocks = {name: list(_blocks(text)) for name, text in read.items()}
    where = {n: name for name in HEADERS for comment, code in blocks[name] if comment != "section" for n in _names(code)}
    rows = []

    def linked(markup, here, own=()):
        def link(found):
            name = found[0]
            if name in own or name not in where:
                return name
            return f"<a href='{'' if where[name] == here else where[name] + '.html'}#{name}'>{name}</a>"
        return re.sub(r"\b(?:koksma|KOKSMA)_\w+\b", link, markup)

    for name in HEADERS:
        head = re.search(r"/\*\n(.*?)\*/", read[name], re.S)[1]
        body, taken = "<h2>Overview</h2>" + linked(prose("\n" + head.rstrip()), name), set()
        for comment, code in blocks[name]:
            if comment == "section":
                body += f"<h2>{html.escape(code)}</h2>"
                continue
            names = [n for n in _names(code) if where[n] == name and n not in taken]
            taken.update(names)
            title = f"<h3 id='{names[0]}'>{', '.join(names)}</h3>" if names else ""
            body += title + "".join(f"<a id='{n}'></a>" for n in names[1:])
            body += f"<pre>{linked(html.escape(code, quote=False), name, names)}</pre>{linked(prose(comment), name)}"
        first = re.match(r"(.*?)\.(?:\s|$)", " ".join(re.sub(r"^ \* ?", "", l) for l in head.splitlines()), re.S)[1].strip()
        site.write(f"c/{name}.html", "C header", f"koksma/{name}.h", html.escape(first), body)
        rows.append([f"<a href='{name}.html'><code>koksma/{name}.h</code></a>", html.escape(first)])
    statuses = re.findall(r'^KOKSMA_STATUS\((\w+), (\d+), (\d+), "([^"]*)"\)', (ROOT / "include/koksma/status.def").read_text(encoding="utf-8"), re.M)
    site.write("c/index.html", "", "C reference", "the public headers; <code>pkg-config koksma</code> has the flags",
               table(["header", "contents"], rows) + "<h2>Statuses</h2>" +
               table(["status", "value", "exit code of the program", "meaning"],
                     [[f"<code>KOKSMA_{n}</code>", v, e, html.escape(t)] for n, v, e, t in statuses]))


# ---- Python


def _docstring(node):
    """A docstring: paragraphs, and examples as code."""
    text = ast.get_docstring(node)
    if not text:
        return ""
    parts = []
    for part in re.split(r"\n\n+", text):
        if part.startswith((">>>", "    ")):
            parts.append(f"<pre>{html.escape(re.sub('(?m)^    ', '', part), quote=False)}</pre>")
        else:
            parts.append(f"<p>{re.sub('`([^`]*)`', lambda m: '<code>' + m[1] + '</code>', html.escape(part, quote=False))}</p>")
    return "".join(parts)


def _signature(name, node, method=False):
    arguments = ast.unparse(node.args)
    arguments = re.sub(r"^self(, )?", "", arguments) if method else arguments
    result = f" -> {ast.unparse(node.returns)}" if node.returns and node.name != "__init__" else ""
    return f"<pre>{html.escape(f'{name}({arguments}){result}', quote=False)}</pre>"


def _class(name, node):
    fields = [(f.target.id, ast.unparse(f.annotation)) for f in node.body if isinstance(f, ast.AnnAssign) and isinstance(f.target, ast.Name)
              and not f.target.id.startswith("_")]
    methods = [f for f in node.body if isinstance(f, ast.FunctionDef) and (f.name == "__init__" or not f.name.startswith("_"))]
    out = "".join(_signature(name, f, True) for f in methods if f.name == "__init__") + _docstring(node)
    if fields:
        out += table(["field", "type"], [[f"<code>{f}</code>", f"<code>{html.escape(t)}</code>"] for f, t in fields])
    for f in methods:
        if f.name == "__init__":
            continue
        kinds = [ast.unparse(d) for d in f.decorator_list]
        if any(k.endswith(".setter") for k in kinds):
            continue
        call = f"<pre>{name}.{f.name}</pre>" if "property" in kinds else _signature(f"{name}.{f.name}", f, True)
        out += call + _docstring(f)
    return out


def python_reference(site):
    """One page: every name of __all__, in its order."""
    folder = ROOT / "python/koksma"
    package = ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))
    nodes = {}
    for path in sorted(folder.glob("_*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                nodes.setdefault(node.name, node)
    public = next(ast.literal_eval(n.value) for n in package.body if isinstance(n, ast.Assign) and n.targets[0].id == "__all__")
    body = "<h2>Overview</h2>" + _docstring(package)
    for name in sorted(public, key=lambda n: (isinstance(nodes.get(n), ast.ClassDef), n)):
        if name not in nodes:
            raise SystemExit(f"python/koksma: no function or class {name}")
        node = nodes[name]
        inner = _class(name, node) if isinstance(node, ast.ClassDef) else _signature(f"koksma.{name}", node) + _docstring(node)
        body += f"<h2 id='{name}'>{name}</h2>{inner}"
    site.write("python/index.html", "", "Python reference", "the package <code>koksma</code>", body)
