// The list of findings with its filters and its search. It is used by mouse and by keys.

import { el, type Child } from "./elements";
import { severities, type Finding, type Report, type Severity } from "./report";

/** Kinds of findings, in the order of the report. */
export function kindsOf(report: Report): string[] {
    return [...new Set(report.findings.map((finding) => finding.kind))];
}

/** Severities that the report has. */
export function severitiesOf(report: Report): Severity[] {
    return severities.filter((severity) => report.findings.some((finding) => finding.severity === severity));
}

export class FindingList {
    readonly element: HTMLElement;
    readonly search = el("input", { type: "search", placeholder: "Search names and texts", "aria-label": "Search findings" });
    private readonly rows = el("ol", { id: "findings", role: "listbox", tabindex: "0", "aria-label": "Findings" });
    private readonly note = el("p", { class: "fine", role: "status" });
    private readonly rowsById: ReadonlyMap<string, HTMLLIElement>;
    private readonly hiddenKinds = new Set<string>();
    private readonly hiddenSeverities = new Set<Severity>();
    private words: readonly string[] = [];
    private listed: readonly Finding[] = [];
    private selected: Finding | undefined;

    constructor(
        private readonly report: Report,
        private readonly onSelect: (finding: Finding) => void,
    ) {
        this.rowsById = new Map(report.findings.map((finding) => [finding.id, this.rowOf(finding)]));
        this.rows.addEventListener("keydown", (event) => this.onRowKey(event));
        this.search.addEventListener("input", () => {
            this.words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
            this.list();
        });
        this.search.addEventListener("keydown", (event) => {
            if (event.key !== "ArrowDown" && event.key !== "Enter") return;
            event.preventDefault();
            this.rows.focus();
            if (!this.selected || !this.listed.includes(this.selected)) this.step(1);
        });
        this.element = el("nav", { class: "left", "aria-label": "Findings" }, this.filters(), this.note, this.rows);
        this.list();
    }

    /** Marks the row of a finding. */
    mark(finding: Finding | undefined): void {
        if (this.selected) this.rowsById.get(this.selected.id)?.setAttribute("aria-selected", "false");
        this.selected = finding;
        this.rows.removeAttribute("aria-activedescendant");
        const row = finding && this.rowsById.get(finding.id);
        row?.setAttribute("aria-selected", "true");
        if (!row?.isConnected) return;
        // The list alone is scrolled, and not the page around it.
        const [box, all] = [row.getBoundingClientRect(), this.rows.getBoundingClientRect()];
        this.rows.scrollTop += Math.min(box.top - all.top, 0) || Math.max(box.bottom - all.bottom, 0);
        this.rows.setAttribute("aria-activedescendant", row.id);
    }

    /** Steps in the list, from the selected finding. */
    step(by: number): void {
        const at = this.selected ? this.listed.indexOf(this.selected) : -1;
        const end = this.listed.length - 1;
        const next = at < 0 ? (by > 0 ? 0 : end) : Math.min(Math.max(at + by, 0), end);
        const finding = this.listed[next];
        if (finding) this.onSelect(finding);
    }

    private onRowKey(event: KeyboardEvent): void {
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
        this.step(by);
    }

    private rowOf(finding: Finding): HTMLLIElement {
        const row = el(
            "li",
            { role: "option", id: `row-${finding.id}`, class: finding.severity, "aria-selected": "false" },
            el("span", { class: "code" }, finding.code),
            el("strong", {}, finding.title),
            el("span", { class: "text" }, finding.text),
        );
        row.addEventListener("click", () => this.onSelect(finding));
        return row;
    }

    private list(): void {
        const { findings, left_out } = this.report;
        this.listed = findings.filter((finding) => this.isListed(finding));
        this.rows.replaceChildren(...this.listed.flatMap((finding) => this.rowsById.get(finding.id) ?? []));
        const shown = this.listed.length === findings.length ? "" : `${this.listed.length} of ${findings.length} findings`;
        const rest = left_out > 0 ? `${left_out} more findings are not on this page; --json lists all.` : "";
        this.note.textContent = [shown, rest].filter(Boolean).join(". ");
    }

    private isListed(finding: Finding): boolean {
        if (this.hiddenKinds.has(finding.kind) || this.hiddenSeverities.has(finding.severity)) return false;
        const text = `${finding.title} ${finding.text} ${finding.code} ${finding.kind}`.toLowerCase();
        return this.words.every((word) => text.includes(word));
    }

    private filters(): HTMLElement {
        const count = (is: (finding: Finding) => boolean): number => this.report.findings.filter(is).length;
        const group = (name: string, ...chips: readonly Child[]): HTMLElement =>
            el("div", { class: "chips", role: "group", "aria-label": name }, ...chips);
        const bySeverity = severitiesOf(this.report).map((severity) =>
            this.toggle(this.hiddenSeverities, severity, `${severity}s`, severity, count((f) => f.severity === severity)),
        );
        const byKind = kindsOf(this.report).map((kind) =>
            this.toggle(this.hiddenKinds, kind, kind, "", count((f) => f.kind === kind)),
        );
        return el("div", { class: "filters" }, this.search, group("Severities", ...bySeverity), group("Kinds", ...byKind));
    }

    private toggle<T>(set: Set<T>, value: T, text: string, className: string, count: number): HTMLButtonElement {
        const button = el("button", { type: "button", class: `chip ${className}`, "aria-pressed": "true" }, text, " ");
        button.append(el("small", {}, String(count)));
        button.addEventListener("click", () => {
            if (!set.delete(value)) set.add(value);
            button.setAttribute("aria-pressed", String(!set.has(value)));
            this.list();
        });
        return button;
    }
}
