// A chart of two bars a row in the panel, such as what was predicted and what was measured.

export interface BarRow {
    readonly label: string;
    /** One for each series; NaN where it is not known yet. */
    readonly values: readonly number[];
    /** Stands out. */
    readonly marked: boolean;
}

export class Bars {
    readonly element = document.createElement("table");
    private readonly body = document.createElement("tbody");

    constructor(
        caption: string,
        private readonly series: readonly string[],
        private readonly text: (value: number) => string,
    ) {
        this.element.className = "bars";
        this.element.createCaption().textContent = caption;
        this.element.append(this.body);
    }

    show(rows: readonly BarRow[]): void {
        const largest = Math.max(...rows.flatMap((row) => row.values).filter(Number.isFinite), 1e-9);
        while (this.body.rows.length > rows.length) this.body.deleteRow(-1);
        while (this.body.rows.length < rows.length) this.addRow();
        rows.forEach(({ label, values, marked }, i) => {
            const row = this.body.rows[i];
            if (!row) return;
            row.classList.toggle("marked", marked);
            setText(row.querySelector("th"), label);
            values.forEach((value, k) => {
                const bar = row.querySelectorAll<HTMLElement>(".bar")[k];
                bar?.style.setProperty("width", `${Number.isFinite(value) ? ((100 * value) / largest).toFixed(1) : 0}%`);
                setText(
                    row.querySelectorAll<HTMLElement>(".value")[k] ?? null,
                    `${this.series[k]} ${Number.isFinite(value) ? this.text(value) : "..."}`,
                );
            });
        });
    }

    private addRow(): void {
        const row = this.body.insertRow();
        const name = document.createElement("th");
        name.scope = "row";
        const cell = document.createElement("td");
        for (const series of this.series) {
            const bar = document.createElement("div");
            bar.className = `bar ${series}`;
            const value = document.createElement("span");
            value.className = "value";
            cell.append(bar, value);
        }
        row.append(name, cell);
    }
}

function setText(element: Element | null, text: string): void {
    if (element && element.textContent !== text) element.textContent = text;
}
