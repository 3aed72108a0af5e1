// SPDX-License-Identifier: Apache-2.0
// The head of a report: the paragraphs that are marked as answers, each below its question; then the contents, and a field
// that filters the rows of all tables.
import { element } from "../../../../explorer/page/dom.mjs";
import { filterTables, plain, unique, words } from "./tables.mjs";

const mostAnswers = 10, levels = 3, marks = { decided: "✓", holds: "✓", partly: "(✓)", fails: "✗" };

// Gives every section an anchor, the id of its heading.
export function addAnchors(content) {
  for (const block of content.filter(b => b.kind === "section")) {
    block.anchor = unique(block.id ?? "part");
    addAnchors(block.content);
  }
}

// The section whose heading is the question of an answer: the innermost section that contains the answer or, in the section
// "questions", the section at the level below it, or below its plan. Conclusions, also those on figures, have their paper.
const ofPaper = path => ["conclusions", "figures"].includes(path.at(-1)?.id);

function questionOf(path) {
  if (ofPaper(path) && path.length > 1) return path.at(-2); // the plan, whose heading is the paper
  if (path[0]?.id !== "questions") return path.at(-1);
  return path[plain(path[1]?.heading ?? []).startsWith("Results:") ? 2 : 1] ?? path[0];
}

function answersIn(content, path = []) {
  return content.flatMap(block => block.kind === "section" ? answersIn(block.content, [...path, block])
    : block.answer ? [{ block, question: questionOf(path), concludes: ofPaper(path) }] : []);
}

// How many conclusions of papers hold; without papers, how many answers the data decide.
function count(answers) {
  const of = answers.filter(a => a.concludes), number = answer => of.filter(a => a.block.answer === answer).length;
  if (!of.length) return `The data decide ${answers.filter(a => a.block.answer !== "undecided").length} of ${answers.length} answers; ? marks the others.`;
  return `Of ${of.length} conclusions ${number("holds")} hold (✓), ${number("partly")} in part ((✓)), ${number("fails")} not (✗); ${number("undecided")} undecided (?).`;
}

function verdict(answers, ...legend) {
  const questions = [...new Set(answers.map(a => a.question))], list = element("dl", {});
  for (const question of questions) {
    const mine = answers.filter(a => a.question === question), link = element("a", { href: `#${question.anchor}` }, plain(question.heading));
    list.append(element("dt", {}, link), ...mine.slice(0, mostAnswers).map(({ block }) =>
      element("dd", { class: block.answer }, element("span", { class: "mark" }, marks[block.answer] ?? "?"), " ", ...words(block.text))));
    if (mine.length > mostAnswers) list.append(element("dd", {}, element("a", { href: `#${question.anchor}` }, `${mine.length - mostAnswers} more`)));
  }
  const sure = `${count(answers)} Intervals are 95 % intervals, approximate where values are skewed.`;
  return element("section", { id: "verdict", "aria-label": "What came out" }, element("h2", {}, "What came out"), ...legend, list, element("p", {}, sure));
}

function tablesIn(content) {
  return content.flatMap(block => block.kind === "section" ? [...block.id?.startsWith("table-") ? [block] : [], ...tablesIn(block.content)] : []);
}

// What the words of a reproduction's answers mean, and where its tables are.
function glossary(content) {
  return element("p", { class: "glossary" }, "Coherence: how far the spectrum of an error peaks; white noise leaves about 3, and more where all trials have the same points. A wave with less than two periods over the picture is a shade, no bands. grain: amplitude of slow errors. Scenes fitted: their cameras and lights were fitted to the printed errors, so that sizes agree in part by construction, and orders and ratios are what is tested. "
    + "Slope: exponent of the number of points; faster: surely below -0.55. z: printed mean minus ours, in standard errors with half of the last printed digit. V(f), D*: variation, star discrepancy. Names such as extreme:grid=20 are those of koksma's measures and patterns with their parameters. Tables:",
    ...tablesIn(content).flatMap(t => [" ", element("a", { href: `#${t.anchor}` }, t.id.slice(6))]));
}

function contents(blocks, level = 1) {
  const items = blocks.filter(b => b.kind === "section" && !b.collapsed).map(b => {
    const below = level < levels ? contents(b.content, level + 1) : null;
    return element("li", {}, element("a", { href: `#${b.anchor}` }, plain(b.heading)), below);
  });
  return items.length ? element("ul", {}, ...items) : null;
}

export function overview(report) {
  const answers = answersIn(report.content), field = element("input", { type: "search" }), reproduces = report.content.some(b => b.id === "agreement");
  field.addEventListener("input", () => filterTables(field.value.trim().toLowerCase()));
  return element("header", {}, element("p", { class: "kicker" }, reproduces ? `Koksma reproduces${report.quick ? ", with the fewer trials of --quick" : ""}` : report.plan ? `A study by koksma ${report.koksma}: ${report.plan}` : `Made by koksma ${report.koksma}`),
    element("h1", {}, report.title), report.about ? element("p", {}, report.about) : null, answers.length ? verdict(answers, ...(reproduces ? [glossary(report.content)] : [])) : null,
    element("nav", { "aria-label": "contents" }, element("details", { open: true }, element("summary", {}, "Contents"), contents(report.content)),
      element("label", { class: "search" }, "Show rows of all tables with ", field)));
}
