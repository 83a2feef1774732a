// The whole state of an exhibit in the address: `#two-shapes?{...}`, with only what differs from the start.

/** The exhibit's name and the members that differ. Broken data is dropped. */
export function readLink(hash: string): { id: string; changes: Record<string, unknown> } {
    const text = hash.replace(/^#/, "");
    const at = text.indexOf("?");
    if (at < 0) return { id: text, changes: {} };
    try {
        const changes: unknown = JSON.parse(decodeURIComponent(text.slice(at + 1)));
        if (typeof changes === "object" && changes !== null && !Array.isArray(changes)) return { id: text.slice(0, at), changes: { ...changes } };
    } catch {
        // An address that was cut off shows the exhibit as it starts.
    }
    return { id: text.slice(0, at), changes: {} };
}

/** The state of the link, checked against the types of the start: members of another type or length are ignored. */
export function stateOf<State extends object>(initial: State, changes: Record<string, unknown>): State {
    const state = structuredClone(initial) as Record<string, unknown>;
    for (const [name, value] of Object.entries(changes)) if (name in state && alike(state[name], value)) state[name] = value;
    return state as State;
}

function alike(a: unknown, b: unknown): boolean {
    if (typeof a === "number") return typeof b === "number" && Number.isFinite(b);
    if (Array.isArray(a)) return Array.isArray(b) && b.length < 4096 && (a.length === 0 || b.every((one) => alike(a[0], one)));
    if (typeof a !== "object" || a === null) return typeof a === typeof b;
    if (typeof b !== "object" || b === null || Array.isArray(b)) return false;
    const entries = b as Record<string, unknown>;
    return Object.entries(a).every(([name, value]) => name in entries && alike(value, entries[name]));
}

export function writeLink<State extends object>(id: string, initial: State, state: State): string {
    const before = initial as Record<string, unknown>;
    const changes: Record<string, unknown> = {};
    for (const [name, value] of Object.entries(state)) if (JSON.stringify(value) !== JSON.stringify(before[name])) changes[name] = value;
    const text = JSON.stringify(changes);
    return text === "{}" ? `#${id}` : `#${id}?${encodeURIComponent(text)}`;
}
