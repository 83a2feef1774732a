// Whether pictures are made by the processor. Then they are plain, and go through as few hands as possible.

let software: boolean | undefined;
export function isSoftware(): boolean {
    if (software === undefined) {
        const probe = document.createElement("canvas").getContext("webgl2");
        const names = probe?.getExtension("WEBGL_debug_renderer_info");
        const name = probe && names ? String(probe.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
        probe?.getExtension("WEBGL_lose_context")?.loseContext();
        software = /swiftshader|llvmpipe|software/i.test(name);
    }
    return software;
}
