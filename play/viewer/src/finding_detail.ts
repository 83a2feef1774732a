// What is known of one finding.

import { el } from "./elements";
import { rounded, type Finding, type Report } from "./report";

/** A heading, which begins with the code, the sentence, and the numbers. */
export function detailOf(report: Report, finding: Finding, code: HTMLElement): HTMLElement[] {
    const severity = el("span", { class: `tag ${finding.severity}` }, finding.severity);
    return [el("h2", {}, code, " ", finding.title), el("p", {}, severity, " ", finding.text), factsOf(report, finding)];
}

function factsOf(report: Report, finding: Finding): HTMLElement {
    const lines = el("dl");
    const add = (name: string, text: string): void => lines.append(el("dt", {}, name), el("dd", {}, text));
    add("place", `(${finding.position.map(rounded).join(", ")})`);
    if (finding.depth !== undefined) add(finding.kind === "gap" ? "width" : "depth", rounded(finding.depth));
    if (finding.normal) add("normal", `(${finding.normal.map(rounded).join(", ")})`);
    if (finding.time && report.samples.length > 1) {
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

/** Lines about the run, and its notes. */
export function aboutOf(report: Report): HTMLElement {
    const lines = el("dl");
    for (const [name, text] of report.summary) lines.append(el("dt", {}, name), el("dd", {}, text));
    const details = el("details", { id: "about" }, el("summary", {}, "About this run"), lines);
    const notes = [...report.notes];
    if (report.objects_left_out > 0) notes.push(`${report.objects_left_out} objects far from findings are not shown.`);
    if (notes.length > 0) details.append(el("ul", {}, ...notes.map((note) => el("li", {}, note))));
    details.append(el("p", { class: "fine" }, `abut ${report.version}`));
    return details;
}
