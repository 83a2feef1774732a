// The page of a report: verdict, table of kinds, list of findings, and a view of the selected one.

import { el } from "./elements";
import { aboutOf, detailOf } from "./finding_detail";
import { FindingList, kindsOf, severitiesOf } from "./finding_list";
import type { Finding, Report } from "./report";
import { ScenePane } from "./scene_pane";

const report = JSON.parse(document.getElementById("report")?.textContent ?? "{}") as Report;

// --- parts of the page ---------------------------------------------------------------------------------------------------

function header(): HTMLElement {
    const verdict = el("p", { class: report.clean ? "verdict clean" : "verdict", id: "verdict" }, report.verdict);
    return el("header", {}, el("h1", {}, report.file), verdict);
}

function tableOfKinds(): HTMLElement {
    const usedSeverities = severitiesOf(report);
    const head = el("tr", {}, el("th", { scope: "col" }, "kind"));
    for (const severity of usedSeverities) head.append(el("th", { scope: "col", class: "number" }, `${severity}s`));
    head.append(el("th", { scope: "col" }, "what it is"));
    const body = el("tbody");
    for (const kind of kindsOf(report)) {
        const row = el("tr", {}, el("th", { scope: "row" }, kind));
        for (const severity of usedSeverities) {
            const number = report.findings.filter((f) => f.kind === kind && f.severity === severity).length;
            row.append(el("td", { class: number > 0 ? `number ${severity}` : "number" }, String(number)));
        }
        row.append(el("td", {}, report.kinds[kind] ?? ""));
        body.append(row);
    }
    return el("table", { id: "kinds" }, el("thead", {}, head), body);
}

// --- selection -----------------------------------------------------------------------------------------------------------

const detail = el("section", { class: "detail", "aria-live": "polite" });
const list = new FindingList(report, select);
const scene = new ScenePane(report, select);
let selected: Finding | undefined;

function select(finding: Finding | undefined): void {
    selected = finding;
    list.mark(finding);
    scene.show(finding);
    if (!finding) {
        detail.replaceChildren(el("p", { class: "fine" }, report.clean ? "" : "Select a finding to see it."));
        return;
    }
    const link = el("a", { href: `#${finding.id}`, class: "code", title: "Link to this finding" }, finding.code);
    detail.replaceChildren(...detailOf(report, finding, link));
    history.replaceState(null, "", `#${finding.id}`);
}

function selectByLink(): void {
    const id = decodeURIComponent(location.hash.slice(1));
    const finding = report.findings.find((candidate) => candidate.id === id);
    if (finding) select(finding);
}

document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target === list.search) return;
    if (event.key === "/") list.search.focus();
    else if (event.key === "j") list.step(1);
    else if (event.key === "k") list.step(-1);
    else return;
    event.preventDefault();
});

// --- all of it -----------------------------------------------------------------------------------------------------------

const top = el("div", { class: "top" }, header());
if (report.findings.length > 0) top.append(tableOfKinds());
top.append(aboutOf(report));
const right = el("main", {}, ...scene.elements, detail);
document.body.append(top, el("div", { class: report.findings.length > 0 ? "panes" : "panes clean" }, list.element, right));
select(undefined);
selectByLink();
addEventListener("hashchange", selectByLink);
if (!selected) list.step(1);
