#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""text.py FOLDER...: the report of a study (FOLDER/report.json) as lines of text, for tests. A heading is "## [id] words",
a paragraph its words, a table "table NAME" with lines "|cell|cell|", a note "1. words", a chart "chart TITLE" with a line for
each series, a figure "figure [id] caption" with a line for each image, pictures "pictures SCENE" with a line for each."""
import json
import sys

from schema import words


def number(value, column):
    if "decimals" in column:
        return "%.*f" % (column["decimals"], value)
    return "%.*g" % (column.get("digits", 4), value)


def cell_text(cell, column):
    if cell is None:
        return "-"
    if isinstance(cell, str):
        return cell
    if isinstance(cell, (int, float)):
        return number(cell, column)
    data = dict(zip(("value", "low", "high"), cell)) if isinstance(cell, list) else cell
    if column["type"] == "verdict":
        return data["verdict"] + (" note %d" % data["note"] if "note" in data else "")
    if data.get("value") is None and "text" not in data:
        return "-"
    text = data.get("text") or number(data["value"], column)
    low, high = data.get("low"), data.get("high")
    if "sd" in data:
        text += " +- %.2g" % data["sd"]
    elif low is not None and high is not None and low != high:
        text += " [%.2g, %.2g]" % (low, high)
    elif low is None and column["type"] == "interval" and "text" not in data:
        text += " +- ?"
    if "sets" in data:
        text += " (%d sets)" % data["sets"]
    if "verdict" in data:
        text += " " + data["verdict"]
    if "note" in data:
        text += " note %d" % data["note"]
    return text


def lines(blocks, level=2):
    for block in blocks:
        kind, mark = block["kind"], " [%s]" % block["id"] if "id" in block else ""
        if kind == "section":
            yield "#" * level + mark + " " + words(block["heading"])
            yield from lines(block["content"], level + 1)
        elif kind == "paragraph":
            yield words(block["text"])
        elif kind == "list":
            for i, item in enumerate(block["items"]):
                yield ("%d. " % (i + 1) if block["numbered"] else "- ") + words(item)
        elif kind == "table":
            shown = [i for i, column in enumerate(block["columns"]) if not column.get("hidden")]
            yield "table " + block["name"]
            groups = [block["columns"][i].get("group", "") for i in shown]
            if any(groups):
                yield "|" + "|".join(groups) + "|"
            yield "|" + "|".join(block["columns"][i].get("title", block["columns"][i]["name"]) for i in shown) + "|"
            for row in block["rows"]:
                yield "|" + "|".join(cell_text(row[i], block["columns"][i]) for i in shown if i < len(row)) + "|"
        elif kind == "chart":
            yield "chart " + block["title"]
            for series in block["series"]:
                yield "  %s %s: %d points" % (series["style"], series["label"], len(series["points"]))
        elif kind == "figure":
            yield "figure" + mark + " " + words(block["caption"])
            for image in block["images"]:
                yield "  %s %dx%d %s" % (image["type"], image["width"], image["height"], image["alt"])
        else:
            yield "pictures %s %dx%d" % (block["scene"], block["width"], block["height"])
            for image in block["images"]:
                yield "  " + image["name"]


for folder in sys.argv[1:]:
    with open(folder + "/report.json") as file:
        report = json.load(file)
    print("# " + report["title"])
    if report["about"]:
        print(report["about"])
    for line in lines(report["content"]):
        print(line)
