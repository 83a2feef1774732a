// Files from outside: by a button of the panel, or dropped on a pane. A file that can't be read leaves the page as it was, and says why
// in one sentence.

import type { Pane } from "../stage/pane";
import type { Panel } from "./panel";

// A file that misses the pane does not replace the page.
for (const name of ["dragover", "drop"] as const) window.addEventListener(name, (event) => event.preventDefault());

/** Offers files to `take`: those whose names end as `accept` says (such as ".obj,.stl"), of at most `maxBytes` together, and none of them
 * empty. `take` throws an Error whose message is a sentence where it can't read them. Returns the button. */
export function dropFiles(
    panel: Panel,
    pane: Pane,
    accept: string,
    maxBytes: number,
    take: (files: File[]) => Promise<void>,
): HTMLButtonElement {
    const note = document.createElement("p");
    note.className = "note";
    note.setAttribute("role", "status");
    const input = document.createElement("input");
    input.type = "file";
    input.accept = accept;
    input.multiple = true;
    input.hidden = true;
    const endings = accept.split(",").map((ending) => ending.trim().toLowerCase());
    let busy = false;

    const offer = async (files: File[]): Promise<void> => {
        if (busy || files.length === 0) return;
        busy = true;
        button.disabled = true;
        note.classList.remove("failed");
        note.textContent = `Reading ${files.map((file) => file.name).join(", ")} ...`;
        try {
            check(files, endings, maxBytes);
            await take(files);
            note.textContent = "";
        } catch (error) {
            note.classList.add("failed");
            note.textContent =
                error instanceof DOMException || !(error instanceof Error) ? "The browser could not read the file." : error.message;
        } finally {
            busy = false;
            button.disabled = false;
        }
    };

    const button = panel.button(`Open a file (${endings.join(" ")})`, () => input.click());
    panel.insert(note);
    panel.insert(input);
    input.addEventListener("change", () => {
        const files = [...(input.files ?? [])];
        // The same file can be chosen again.
        input.value = "";
        void offer(files);
    });
    pane.element.addEventListener("dragover", (event) => {
        event.preventDefault();
        pane.element.classList.add("dropping");
    });
    pane.element.addEventListener("dragleave", () => pane.element.classList.remove("dropping"));
    pane.element.addEventListener("drop", (event) => {
        event.preventDefault();
        pane.element.classList.remove("dropping");
        void offer([...(event.dataTransfer?.files ?? [])]);
    });
    return button;
}

function check(files: readonly File[], endings: readonly string[], maxBytes: number): void {
    let bytes = 0;
    for (const file of files) {
        if (!endings.some((ending) => file.name.toLowerCase().endsWith(ending)))
            throw new Error(`${file.name} is not one of ${endings.join(", ")}, which this exhibit reads.`);
        if (file.size === 0) throw new Error(`${file.name} is empty.`);
        bytes += file.size;
    }
    if (bytes <= maxBytes) return;
    const what = files.length === 1 ? `${files[0]?.name} has` : "The files have";
    throw new Error(`${what} ${megabytes(bytes)}; this exhibit reads at most ${megabytes(maxBytes)}.`);
}

function megabytes(bytes: number): string {
    return `${(bytes / 1e6).toFixed(bytes < 1e7 ? 1 : 0)} MB`;
}
