// Shows the exhibit that the address names, and starts another one when that changes.

import type { AnyExhibit, Context, Running } from "./exhibit";
import { exhibits, type Entry } from "./exhibits/exhibits";
import { loadLibrary, type Abut } from "./library";
import { readLink, stateOf, writeLink } from "./link";
import { Panel } from "./panel/panel";
import { Palette } from "./stage/drawing";
import { Redraw, type Pane } from "./stage/pane";
import { Pane2 } from "./stage/pane2";
import { Pane3 } from "./stage/pane3";

const find = (id: string): HTMLElement => document.getElementById(id) as HTMLElement;
const palette = new Palette(document.documentElement);

/** One exhibit with its panes, from the address. */
class Show {
    private readonly panes: Pane[];
    private readonly panel: Panel;
    private readonly running: Running;
    private readonly redraw = new Redraw(() => this.draw());
    private frame = 0;
    private last = 0;
    private saving = 0;
    private writing = 0;

    constructor(
        abut: Abut,
        private readonly entry: Entry,
        private readonly exhibit: AnyExhibit,
        private readonly state: object,
        restart: (state: object) => void,
    ) {
        const descriptions = exhibit.panes(state);
        find("panes").dataset["count"] = String(descriptions.length);
        this.panes = descriptions.map(({ title, dimension, center, reach }) =>
            dimension === 2 ? new Pane2(abut, palette, title, center, reach) : new Pane3(abut, palette, title, center, reach),
        );
        find("panes").replaceChildren(...this.panes.map((pane) => pane.element));
        const changed = (): void => {
            this.save();
            if (this.running.advance) this.wake();
            else this.redraw.request();
        };
        this.panel = new Panel(find("panel"), entry.title, exhibit.meaning, changed);
        const context: Context<object> = {
            abut,
            state,
            panel: this.panel,
            panes: this.panes,
            changed,
            restart: () => {
                this.save(true);
                restart(state);
            },
        };
        this.running = exhibit.start(context);
        if (this.running.test) {
            const copy = this.panel.button("Copy as a C++ test", () => {
                void navigator.clipboard.writeText(this.running.test?.() ?? "").then(() => {
                    copy.textContent = "Copied";
                    setTimeout(() => (copy.textContent = "Copy as a C++ test"), 1500);
                });
            });
        }
        this.draw();
        this.writeCode();
        this.wake();
    }

    draw(): void {
        this.running.draw();
        this.panel.refresh();
        this.writing ||= window.setTimeout(() => this.writeCode(), 100);
    }
    /** A few times a second, as it takes as long as the rest of a frame. */
    private writeCode(): void {
        this.writing = 0;
        const { cpp, javascript } = this.running.code();
        this.panel.setCode({ "C++": cpp, JavaScript: javascript });
    }
    async ready(): Promise<void> {
        await this.running.ready;
    }
    answers(): Readonly<Record<string, unknown>> {
        return this.running.answers?.() ?? {};
    }
    dispose(): void {
        cancelAnimationFrame(this.frame);
        clearTimeout(this.saving);
        clearTimeout(this.writing);
        this.redraw.cancel();
        this.running.dispose?.();
        this.panel.dispose();
        for (const pane of this.panes) pane.dispose();
    }

    /** Writes the link: at most a few times a second, as browsers limit it. */
    private save(now = false): void {
        clearTimeout(this.saving);
        const write = (): void => history.replaceState(null, "", writeLink(this.entry.id, this.exhibit.initial as object, this.state));
        if (now) write();
        else this.saving = window.setTimeout(write, 300);
    }
    private wake(): void {
        if (!this.running.advance || this.frame !== 0) return;
        this.last = performance.now();
        const step = (time: number): void => {
            const goesOn = this.running.advance?.(Math.min(Math.max(time - this.last, 0) / 1000, 1 / 20)) ?? false;
            this.last = time;
            this.draw();
            this.frame = goesOn ? requestAnimationFrame(step) : 0;
        };
        this.frame = requestAnimationFrame(step);
    }
}

function showTheme(): void {
    palette.refresh();
    current?.draw();
}

/** The label of the control that has the focus, which goes to the control of the same label when an exhibit restarts. */
function focusedLabel(): string | null {
    const focused = document.activeElement;
    return focused instanceof HTMLInputElement || focused instanceof HTMLSelectElement ? (focused.labels?.[0]?.textContent ?? null) : null;
}
function focusControl(label: string): void {
    const labels = [...find("panel").querySelectorAll("label")];
    labels.find((one) => one.textContent === label)?.control?.focus({ preventScroll: true });
}

let current: Show | undefined;

function start(abut: Abut): void {
    const menu = find("exhibits");
    const links = exhibits.map((exhibit) => {
        const link = document.createElement("a");
        link.href = `#${exhibit.id}`;
        link.textContent = exhibit.title;
        return link;
    });
    menu.replaceChildren(...links);
    /** The latest call wins, if exhibits are loaded slowly. */
    let wanted: Entry | undefined;
    const open = async (entry: Entry, changes: Record<string, unknown>): Promise<void> => {
        wanted = entry;
        const exhibit = await entry.load();
        if (wanted === entry) show(entry, exhibit, stateOf(exhibit.initial as object, changes));
    };
    const show = (entry: Entry, exhibit: AnyExhibit, state: object): void => {
        const label = focusedLabel();
        current?.dispose();
        current = undefined;
        document.title = `${entry.title} · abut playground`;
        exhibits.forEach((one, i) => {
            if (one === entry) {
                links[i]?.setAttribute("aria-current", "page");
                links[i]?.scrollIntoView({ block: "nearest", inline: "nearest" });
            } else links[i]?.removeAttribute("aria-current");
        });
        // Before the next frame, as the state may no longer fit the panes.
        const shown = new Show(abut, entry, exhibit, state, (next) =>
            void Promise.resolve(structuredClone(next)).then((copy) => show(entry, exhibit, copy)).catch(report),
        );
        current = shown;
        if (label) focusControl(label);
        find("status").textContent = "Working ...";
        void shown.ready().then(() => {
            if (current === shown) find("status").hidden = true;
        }, report);
    };
    const openLink = (): void => {
        const { id, changes } = readLink(location.hash);
        const entry = exhibits.find((one) => one.id === id) ?? exhibits[0];
        if (entry) void open(entry, changes).catch(report);
    };
    addEventListener("hashchange", openLink);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", showTheme);
    find("theme").addEventListener("click", () => {
        const isDark = getComputedStyle(document.documentElement).colorScheme === "dark";
        document.documentElement.dataset["theme"] = isDark ? "light" : "dark";
        showTheme();
    });
    // For tests of the page and for those who look behind it.
    Object.assign(window, { playground: { abut, answers: () => current?.answers() ?? {} } });
    openLink();
}

function report(error: unknown): void {
    const status = find("status");
    status.hidden = false;
    status.textContent = error instanceof Error ? error.message : String(error);
}

loadLibrary().then(start, report);
