// The page of a report: verdict, table of kinds, list of findings, and a view of the selected one.

import { rounded, severities, type Finding, type Report, type Severity, type View } from "./report";
import { Timeline } from "./timeline";
import { View2 } from "./view2";
import { View3 } from "./view3";

type Child = Node | string;

/** An element with attributes and children. Texts are never taken as HTML. */
function el<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    attributes: Readonly<Record<string, string>> = {},
    ...children: readonly Child[]
): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    return element;
}

const report = JSON.parse(document.getElementById("report")?.textContent ?? "{}") as Report;

// --- filters -------------------------------------------------------------------------------------------------------------

const hiddenKinds = new Set<string>();
const hiddenSeverities = new Set<Severity>();
let words: readonly string[] = [];

function isListed(finding: Finding): boolean {
    if (hiddenKinds.has(finding.kind) || hiddenSeverities.has(finding.severity)) return false;
    const text = `${finding.title} ${finding.text} ${finding.code} ${finding.kind}`.toLowerCase();
    return words.every((word) => text.includes(word));
}

function toggle<T>(set: Set<T>, value: T, text: string, className: string, count: number): HTMLButtonElement {
    const button = el("button", { type: "button", class: `chip ${className}`, "aria-pressed": "true" }, text, " ");
    button.append(el("small", {}, String(count)));
    button.addEventListener("click", () => {
        if (!set.delete(value)) set.add(value);
        button.setAttribute("aria-pressed", String(!set.has(value)));
        list();
    });
    return button;
}

// --- parts of the page ---------------------------------------------------------------------------------------------------

const kinds = [...new Set(report.findings.map((finding) => finding.kind))];
const count = (is: (finding: Finding) => boolean): number => report.findings.filter(is).length;
const usedSeverities = severities.filter((severity) => count((f) => f.severity === severity) > 0);

function header(): HTMLElement {
    const verdict = el("p", { class: report.clean ? "verdict clean" : "verdict", id: "verdict" }, report.verdict);
    return el("header", {}, el("h1", {}, report.file), verdict);
}

function tableOfKinds(): HTMLElement {
    const head = el("tr", {}, el("th", { scope: "col" }, "kind"));
    for (const severity of usedSeverities) head.append(el("th", { scope: "col", class: "number" }, `${severity}s`));
    head.append(el("th", { scope: "col" }, "what it is"));
    const body = el("tbody");
    for (const kind of kinds) {
        const row = el("tr", {}, el("th", { scope: "row" }, kind));
        for (const severity of usedSeverities) {
            const number = count((f) => f.kind === kind && f.severity === severity);
            row.append(el("td", { class: number > 0 ? `number ${severity}` : "number" }, String(number)));
        }
        row.append(el("td", {}, report.kinds[kind] ?? ""));
        body.append(row);
    }
    return el("table", { id: "kinds" }, el("thead", {}, head), body);
}

function about(): HTMLElement {
    const lines = el("dl");
    for (const [name, text] of report.summary) lines.append(el("dt", {}, name), el("dd", {}, text));
    const details = el("details", { id: "about" }, el("summary", {}, "About this run"), lines);
    const notes = [...report.notes];
    if (report.objects_left_out > 0) notes.push(`${report.objects_left_out} objects far from findings are not shown.`);
    if (notes.length > 0) details.append(el("ul", {}, ...notes.map((note) => el("li", {}, note))));
    details.append(el("p", { class: "fine" }, `abut ${report.version}`));
    return details;
}

const rows = el("ol", { id: "findings", role: "listbox", tabindex: "0", "aria-label": "Findings" });
const none = el("p", { class: "fine", role: "status" });
const search = el("input", { type: "search", placeholder: "Search names and texts", "aria-label": "Search findings" });
const detail = el("section", { class: "detail", "aria-live": "polite" });
let listed: readonly Finding[] = [];
let selected: Finding | undefined;

function rowOf(finding: Finding): HTMLLIElement {
    const row = el(
        "li",
        { role: "option", id: `row-${finding.id}`, class: finding.severity, "aria-selected": "false" },
        el("span", { class: "code" }, finding.code),
        el("strong", {}, finding.title),
        el("span", { class: "text" }, finding.text),
    );
    row.addEventListener("click", () => select(finding));
    return row;
}
const rowsById = new Map(report.findings.map((finding) => [finding.id, rowOf(finding)]));

function list(): void {
    listed = report.findings.filter(isListed);
    rows.replaceChildren(...listed.flatMap((finding) => rowsById.get(finding.id) ?? []));
    const all = report.findings.length;
    const shown = listed.length === all ? "" : `${listed.length} of ${all} findings`;
    const rest = report.left_out > 0 ? `${report.left_out} more findings are not on this page; --json lists all.` : "";
    none.textContent = [shown, rest].filter(Boolean).join(". ");
}

// --- selection -----------------------------------------------------------------------------------------------------------

function viewOf(): View | undefined {
    try {
        return report.dimension === 3 ? new View3(report) : new View2(report);
    } catch {
        return undefined;
    }
}
const view = viewOf();
const isAnimated = report.samples.length > 1;
const timeline = isAnimated ? new Timeline(report, (seconds) => view?.setTime(seconds), select) : undefined;

function facts(finding: Finding): HTMLElement {
    const lines = el("dl");
    const add = (name: string, text: string): void => lines.append(el("dt", {}, name), el("dd", {}, text));
    add("place", `(${finding.position.map(rounded).join(", ")})`);
    if (finding.depth !== undefined) add(finding.kind === "gap" ? "width" : "depth", rounded(finding.depth));
    if (finding.normal) add("normal", `(${finding.normal.map(rounded).join(", ")})`);
    if (finding.time && isAnimated) {
        const [first, last, shown] = finding.time.map(rounded);
        add("time", first === last ? `${shown} s` : `${first} s to ${last} s, shown at ${shown} s`);
    }
    finding.parties.forEach((party, i) => {
        for (const index of party.slice(0, 20)) {
            const name = el("dd", { class: `party${i % 2}` }, report.objects[index]?.name ?? "");
            lines.append(el("dt", {}, "object"), name);
        }
    });
    return lines;
}

function select(finding: Finding | undefined): void {
    if (selected) rowsById.get(selected.id)?.setAttribute("aria-selected", "false");
    selected = finding;
    rows.removeAttribute("aria-activedescendant");
    if (!finding) {
        detail.replaceChildren(el("p", { class: "fine" }, report.clean ? "" : "Select a finding to see it."));
        view?.show(undefined);
        return;
    }
    const row = rowsById.get(finding.id);
    row?.setAttribute("aria-selected", "true");
    row?.scrollIntoView({ block: "nearest" });
    if (row?.isConnected) rows.setAttribute("aria-activedescendant", row.id);
    const link = el("a", { href: `#${finding.id}`, class: "code", title: "Link to this finding" }, finding.code);
    const severity = el("span", { class: `tag ${finding.severity}` }, finding.severity);
    detail.replaceChildren(
        el("h2", {}, link, " ", finding.title),
        el("p", {}, severity, " ", finding.text),
        facts(finding),
    );
    view?.show(finding);
    timeline?.show(finding);
    history.replaceState(null, "", `#${finding.id}`);
}

function selectByLink(): void {
    const id = decodeURIComponent(location.hash.slice(1));
    const finding = report.findings.find((candidate) => candidate.id === id);
    if (finding) select(finding);
}

/** Steps in the list, from the selected finding. */
function step(by: number): void {
    const at = selected ? listed.indexOf(selected) : -1;
    const next = at < 0 ? (by > 0 ? 0 : listed.length - 1) : Math.min(Math.max(at + by, 0), listed.length - 1);
    if (listed[next]) select(listed[next]);
}

// --- keys ----------------------------------------------------------------------------------------------------------------

rows.addEventListener("keydown", (event) => {
    const steps: Readonly<Record<string, number>> = {
        ArrowDown: 1,
        ArrowUp: -1,
        PageDown: 10,
        PageUp: -10,
        Home: -Infinity,
        End: Infinity,
    };
    const by = steps[event.key];
    if (by === undefined) return;
    event.preventDefault();
    step(by);
});
document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target === search) return;
    if (event.key === "/") search.focus();
    else if (event.key === "j") step(1);
    else if (event.key === "k") step(-1);
    else return;
    event.preventDefault();
});
search.addEventListener("input", () => {
    words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    list();
});
search.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown" && event.key !== "Enter") return;
    event.preventDefault();
    rows.focus();
    if (!selected || !listed.includes(selected)) step(1);
});

function viewPane(): HTMLElement {
    const pane = el("div", { class: "view", role: "group", "aria-label": "View of the finding" });
    if (!view) {
        pane.append(el("p", { class: "fine" }, "This browser has no WebGL, so there is no picture."));
        return pane;
    }
    const canvas = view.element.querySelector("canvas");
    canvas?.setAttribute("tabindex", "0");
    canvas?.setAttribute("role", "img");
    canvas?.setAttribute("aria-label", "The scene; arrow keys turn it, + and - zoom");
    const turns: Readonly<Record<string, readonly [number, number]>> = {
        ArrowLeft: [-1, 0],
        ArrowRight: [1, 0],
        ArrowUp: [0, 1],
        ArrowDown: [0, -1],
    };
    canvas?.addEventListener("keydown", (event) => {
        const turn = turns[event.key];
        if (turn) view.turn(...turn);
        else if (event.key === "+" || event.key === "=") view.zoom(1.25);
        else if (event.key === "-") view.zoom(0.8);
        else return;
        event.preventDefault();
    });
    const buttons = el("div", { class: "buttons" });
    const button = (text: string, name: string, act: () => void): void => {
        const element = el("button", { type: "button", "aria-label": name, title: name }, text);
        element.addEventListener("click", act);
        buttons.append(element);
    };
    button("+", "Zoom in", () => view.zoom(1.25));
    button("−", "Zoom out", () => view.zoom(0.8));
    button("⌂", "Whole scene", () => view.show(undefined));
    button("◎", "Back to the finding", () => view.show(selected));
    pane.append(view.element, buttons);
    return pane;
}

// --- all of it -----------------------------------------------------------------------------------------------------------

function filters(): HTMLElement {
    const group = (name: string, ...chips: readonly Child[]): HTMLElement =>
        el("div", { class: "chips", role: "group", "aria-label": name }, ...chips);
    const bySeverity = usedSeverities.map((severity) =>
        toggle(hiddenSeverities, severity, `${severity}s`, severity, count((f) => f.severity === severity)),
    );
    const byKind = kinds.map((kind) => toggle(hiddenKinds, kind, kind, "", count((f) => f.kind === kind)));
    return el("div", { class: "filters" }, search, group("Severities", ...bySeverity), group("Kinds", ...byKind));
}

const top = el("div", { class: "top" }, header());
if (kinds.length > 0) top.append(tableOfKinds());
top.append(about());
const left = el("nav", { class: "left", "aria-label": "Findings" }, filters(), none, rows);
const right = el("main", {}, viewPane());
if (timeline) right.append(timeline.element);
right.append(detail);
document.body.append(top, el("div", { class: report.findings.length > 0 ? "panes" : "panes clean" }, left, right));
list();
select(undefined);
selectByLink();
addEventListener("hashchange", selectByLink);
if (!selected) step(1);
