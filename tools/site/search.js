// SPDX-License-Identifier: Apache-2.0
// Search over all pages: the index (search-index.js) is a script, as a page that is opened from disk may fetch nothing, and is
// loaded with the first letter. A section is found when each word of the query begins a word of it; those with the words in
// their titles come first, and before them one of that name; pages for those who change Koksma come last. Small words of a
// question ("how do I rank my scene") need not be found. What is folded is printed unfolded.
"use strict";
(() => {
  const up = document.documentElement.dataset.up, input = document.querySelector("#search input"), list = document.getElementById("found");
  let sections = null, isLoading = false;
  const small = new Set("a an and are can do does for how i in is it me my of on or the this to what when where which why with you your".split(" "));
  const forDevelopers = /^guide\/decisions/;

  const escape = text => text.replace(/[\\^$.*+?()[\]{}|]/g, "\\$&");
  const begins = word => new RegExp(`(^|[^\\p{L}\\p{N}])${escape(word)}`, "iu");

  function load() {
    if (isLoading) return;
    isLoading = true;
    const script = document.createElement("script");
    script.src = up + "search-index.js";
    script.onload = () => { sections = globalThis.koksmaSections; show(); };
    script.onerror = () => { isLoading = false; say("The index of the search, search-index.js, is missing."); };
    document.head.append(script);
  }

  function say(text) {
    list.replaceChildren(Object.assign(document.createElement("li"), { textContent: text }));
    list.hidden = false;
  }

  // [address, title of the page, heading, text]
  function score([address, title, heading, text], words, query) {
    let sum = 0;
    for (const word of words) {
      const here = (word.test(title) ? 8 : 0) + (heading && word.test(heading) ? 6 : 0) + (word.test(text) ? 1 : 0) +
        (new RegExp(`^${word.source}$`, "iu").test(heading || title) ? 6 : 0);
      if (!here) return 0;
      sum += here;
    }
    const name = `${title} ${heading}`, letters = text => text.toLowerCase().replace(/[^\p{L}\p{N}]+/gu, " ").trim();
    const whole = letters(heading || title) === letters(query.join(" ")); // "min distance" is min-distance
    return (sum + (heading ? 0 : 0.5) + (words.every(word => word.test(name)) ? 10 : 0) + (whole ? 20 : 0)) * (forDevelopers.test(address) ? 0.3 : 1);
  }

  function snippet(text, words) {
    const at = Math.max(0, Math.min(...words.map(word => text.search(word)).filter(i => i >= 0), text.length) - 40);
    const part = document.createElement("small"), cut = (at ? "… " : "") + text.slice(at, at + 180);
    const marks = new RegExp(words.map(word => word.source).join("|"), "giu");
    let from = 0;
    for (const match of cut.matchAll(marks)) {
      const begin = match.index + (/^[\p{L}\p{N}]/u.test(match[0]) ? 0 : 1), end = match.index + match[0].length;
      if (end <= begin) continue;
      part.append(cut.slice(from, begin), Object.assign(document.createElement("mark"), { textContent: cut.slice(begin, end) }));
      from = end;
    }
    part.append(cut.slice(from));
    return part;
  }

  // Whether one letter put in, left out or replaced, or two swapped, makes the name of the word.
  function near(word, name) {
    let from = 0, a = word.length, b = name.length;
    if (Math.abs(a - b) > 1) return false;
    while (from < a && word[from] === name[from]) from++;
    while (a > from && b > from && word[a - 1] === name[b - 1]) { a--; b--; }
    return a - from <= 1 && b - from <= 1 || a - from === 2 && b - from === 2 && word[from] === name[from + 1] && word[from + 1] === name[from];
  }

  // The query with the nearest word of a title for each that is in no page, or null.
  function meant(query) {
    const names = [...new Set(sections.flatMap(([, title, heading]) => `${title} ${heading}`.toLowerCase().split(/[^\p{L}\p{N}_-]+/u)))];
    const nearest = query.map(word => sections.some(([, title, heading, text]) => begins(word).test(`${title} ${heading} ${text}`)) ? word
      : names.find(name => name.length > 2 && near(word.toLowerCase(), name)));
    return nearest.every(Boolean) && nearest.join(" ") !== query.join(" ") ? nearest.join(" ") : null;
  }

  function suggest(query) {
    const other = meant(query);
    say(`Nothing has ${query.join(" ")}${other ? "; did you mean " : "."}`);
    if (!other) return;
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: other });
    button.onclick = () => { input.value = other; input.focus(); show(); };
    list.firstChild.append(button, "?");
  }

  function show() {
    const typed = input.value.trim().split(/\s+/).filter(Boolean), large = typed.filter(word => !small.has(word.toLowerCase()));
    const query = large.length ? large : typed, words = query.map(begins);
    list.hidden = !words.length || !sections; // until the index is there, nothing is known to be missing
    if (list.hidden) return;
    const found = sections.map(section => [score(section, words, query), section]).filter(([points]) => points > 0).sort((a, b) => b[0] - a[0]);
    if (!found.length) return void suggest(query);
    list.replaceChildren(...found.slice(0, 12).map(([, [address, title, heading, text]]) => {
      const item = document.createElement("li"), link = document.createElement("a");
      link.href = up + address;
      link.textContent = title + (heading ? ` › ${heading}` : "");
      link.onclick = () => { list.hidden = true; };
      item.append(link, snippet(text, words));
      return item;
    }));
  }

  input.addEventListener("input", () => { load(); show(); });
  document.getElementById("search").addEventListener("submit", event => {
    event.preventDefault();
    list.querySelector("a, button")?.click();
  });
  document.getElementById("search").addEventListener("keydown", event => {
    if (event.key === "Escape") {
      list.hidden = true;
      input.focus();
    }
    const links = [...list.querySelectorAll("a, button")], at = links.indexOf(document.activeElement);
    const next = { ArrowDown: at + 1, ArrowUp: at - 1 }[event.key];
    if (next === undefined || list.hidden) return;
    (links[next] || input).focus();
    event.preventDefault();
  });
  document.addEventListener("keydown", event => { // from anywhere on the page
    if (event.key !== "/" || event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, textarea, select")) return;
    event.preventDefault();
    input.focus();
    input.select();
  });
  document.addEventListener("click", event => { if (!event.target.closest("#search")) list.hidden = true; });
  document.querySelector("#search").hidden = false;
  const folded = []; // what is printed unfolded
  addEventListener("beforeprint", () => document.querySelectorAll("main details:not([open])").forEach(node => { folded.push(node); node.open = true; }));
  addEventListener("afterprint", () => folded.splice(0).forEach(node => { node.open = false; }));
})();
