"""`abut bake` with a cache behind a URL: http_cache_test.py ABUT FOLDER"""

import http.server
import shutil
import subprocess
import sys
import threading
from pathlib import Path

abut, folder = sys.argv[1], Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
stored, refuses = {}, False


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def answer(self, status, body=b""):
        self.send_response(status)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        body = stored.get(self.path)
        self.answer(404 if body is None else 200, body or b"")

    def do_PUT(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        if not refuses:
            stored[self.path] = body
        self.answer(403 if refuses else 201)

    def log_message(self, *_):
        pass


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
threading.Thread(target=server.serve_forever, daemon=True).start()
url = f"http://127.0.0.1:{server.server_port}/abut/"

subprocess.run([sys.executable, str(Path(__file__).with_name("make_meshes.py")), "3", str(folder / "meshes")], check=True)


def bake(cache, *more, code=0):
    ran = subprocess.run([abut, "bake", str(folder / "meshes/list.txt"), "--verb", "hull", "--cache", cache, *more],
                         capture_output=True, text=True, env={"PATH": "/usr/bin:/bin", "no_proxy": "*"})
    if ran.returncode == 2 and "needs libcurl" in ran.stderr:
        print("skipped:", ran.stderr)
        sys.exit(77)
    assert ran.returncode == code, (ran.returncode, ran.stdout, ran.stderr)
    return ran


assert bake(url).stdout == "hull 3 files: 3 made\n"
assert len(stored) == 6, sorted(stored)
assert bake(url).stdout == "hull 3 files: 3 in the cache\n"
bake(url, "--report")
bake(url, "--audit", "100")

# The bytes are those of a folder.
bake(str(folder / "cache"))
files = {"/abut/" + file.relative_to(folder / "cache").as_posix(): file.read_bytes()
         for file in (folder / "cache").rglob("*") if file.is_file()}
assert files == stored

# What fails is one line that names the place.
stored.clear()
refuses = True
line = bake(url, code=2).stderr
assert line.startswith("abut: http://127.0.0.1:") and line.endswith(": the server answers 403\n"), line
server.shutdown()
server.server_close()
line = bake(url, code=2).stderr
assert line.count("\n") == 1 and "127.0.0.1" in line, line
print("passed")
