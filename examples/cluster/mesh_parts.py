"""Meshes every part of a folder on a Ray cluster, or as a Slurm job array. What is done stays done.

Each part is a task: the command line of Tetrafront meshes one file, within limits of memory and time. If a
machine dies, its parts are meshed again on others. A part that fails is a row of the table, with its reason.
The files travel through Ray: machines share no folder, and only this program writes into OUT.

    pip install ray
    npm install -g tetrafront                     (on every machine)
    python mesh_parts.py parts meshes             (on this machine)
    python mesh_parts.py parts meshes --address 10.0.0.1:6379 --memory 8G --minutes 20 -- --size 0.5
    python mesh_parts.py parts meshes --slurm > parts.sh && sbatch parts.sh

OUT gets NAME.vtu and NAME.report.json per part, and the table parts.csv. Run the same command again after an
interruption of any kind: it meshes only the parts that are not done, that failed, or that have changed since.
"""

import argparse
import csv
import io
import json
import math
import os
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections import Counter, deque
from dataclasses import dataclass, field
from pathlib import Path

EXTENSIONS = (".stl", ".step", ".stp", ".iges", ".igs", ".brep", ".3mf", ".obj", ".ply", ".off", ".json")
REPORT = ".report.json"
TABLE = "parts.csv"
COLUMNS = (
    "part",
    "status",
    "reason",
    "tetrahedra",
    "nodes",
    "smallest_angle",
    "largest_angle",
    "mean_radius_ratio",
    "volume",
    "lattice",
    "warnings",
    "seconds",
    "memory_mb",
    "tries",
    "node",
    "mesh",
)
MIB = 1 << 20
# Memory is measured this often: a part can exceed its limit for this long.
SECONDS_BETWEEN_LOOKS = 0.2
# The table is written again at most this often while parts are meshed.
SECONDS_BETWEEN_TABLES = 2.0
# Parts that are handed to Ray beyond those that run: a machine that has finished a part need not wait.
AHEAD = 2
# Slurm's default limit is 1001 elements of an array.
LARGEST_ARRAY = 1000
# Memory of this program beside that of the part.
SLURM_MARGIN_MB = 256


@dataclass(frozen=True)
class Settings:
    """How each part is meshed."""

    command: tuple[str, ...]
    options: tuple[str, ...]
    extension: str
    memory: int
    seconds: float
    cpus: int


# What runs on a machine of the cluster. These functions know nothing of Ray or of the folders.


def mesh_part(name, content, settings):
    """Meshes one part. Returns its row, the report of Tetrafront, and the files of the mesh by their ends."""
    begin = time.monotonic()
    row = {"part": name, "status": "failed", "reason": "", "node": socket.gethostname()}
    with tempfile.TemporaryDirectory(prefix="tetrafront-") as folder:
        part = Path(folder, name)
        mesh, report_file, messages = (Path(folder, f"out{end}") for end in (settings.extension, REPORT, ".txt"))
        part.write_bytes(content)
        command = [*found(settings.command), "mesh", f"./{name}", "-o", mesh.name, "--report", report_file.name, "-q"]
        with messages.open("wb") as stderr:
            reason, status, peak = limited([*command, *settings.options], folder, stderr, settings)
        report = json.loads(report_file.read_text()) if report_file.exists() else None
        is_done = reason == "" and status == 0 and mesh.exists()
        if is_done:
            row.update(measures(report), status="done")
        else:
            row["reason"] = reason or reason_in(report, messages.read_text(errors="replace"), status)
        row["seconds"] = round(time.monotonic() - begin, 2)
        row["memory_mb"] = round(peak / MIB)
        # Some formats have several files.
        made = Path(folder).glob("out.*") if is_done else []
        files = {one.name[len("out") :]: one.read_bytes() for one in made if one not in (report_file, messages)}
        return {"row": row, "report": report, "files": files}


def found(command):
    """Returns the command with the path of its program: installed, or in the node_modules of a folder above."""
    program, *rest = command
    if shutil.which(program) is not None:
        return [program, *rest]
    for folder in (*Path(__file__).resolve().parents, Path.cwd(), *Path.cwd().parents):
        installed = folder / "node_modules" / ".bin" / program
        if installed.exists():
            return [str(installed), *rest]
    raise FileNotFoundError(
        f'there is no "{program}" on {socket.gethostname()}: install it there (npm install -g tetrafront), '
        "or state its command with --command"
    )


def limited(command, folder, stderr, settings):
    """Runs a command; ends it at a limit. Returns the limit in words (or ""), the exit code, and bytes used."""
    # On Linux, the command ends with this process, which Ray or Slurm may kill.
    tied = ["setpriv", "--pdeathsig", "KILL"] if shutil.which("setpriv") else []
    process = subprocess.Popen(
        [*tied, *command], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=stderr,
        start_new_session=True,
    )  # fmt: skip
    deadline = time.monotonic() + settings.seconds
    reason, peak = "", 0
    try:
        while reason == "":
            try:
                process.wait(SECONDS_BETWEEN_LOOKS)
                break
            except subprocess.TimeoutExpired:
                peak = max(peak, memory_of_group(process.pid))
            if peak > settings.memory:
                reason = f"out of memory: more than {settings.memory // MIB} MB (--memory)"
            elif time.monotonic() > deadline:
                reason = f"out of time: more than {settings.seconds / 60:g} minutes (--minutes)"
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
    return reason, process.returncode, peak


def memory_of_group(group):
    """Returns the resident bytes of a process group."""
    if not Path("/proc/self/stat").exists():
        listed = subprocess.run(["ps", "-A", "-o", "pgid=,rss="], capture_output=True, text=True).stdout
        rows = (line.split() for line in listed.splitlines())
        return sum(1024 * int(rss) for pgid, rss in rows if int(pgid) == group)
    pages = 0
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            # The name of the program, in parentheses, may contain spaces.
            numbers = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(numbers[2]) == group:
            pages += int(numbers[21])
    return pages * os.sysconf("SC_PAGE_SIZE")


def measures(report):
    """Returns the columns that a report of Tetrafront fills."""
    return {
        "tetrahedra": report["tetrahedra"],
        "nodes": report["nodes"],
        "smallest_angle": report["dihedral"]["min"],
        "largest_angle": report["dihedral"]["max"],
        "mean_radius_ratio": report["radiusRatio"]["mean"],
        "volume": report["volume"],
        "lattice": report["interior"]["lattice"],
        "warnings": sum(found["severity"] == "warning" for found in report["diagnostics"]),
    }


def reason_in(report, messages, status):
    """Returns why a run without a mesh failed: its first error, or the end of its messages."""
    if report is not None:
        errors = [found["message"] for found in report["diagnostics"] if found["severity"] == "error"]
        if errors:
            return errors[0]
        if report["status"] != "done":
            return report["status"]
    lines = messages.strip().splitlines()
    if status < 0:
        ended = f"ended by {signal.Signals(-status).name}"
        return f"{ended}, possibly because the machine is out of memory" if status == -9 else ended
    return lines[-1] if lines else f"exit code {status}"


# The folders: which parts there are, and what is done.


@dataclass
class Store:
    """Parts of one folder, and their results in another. Every file appears whole, under its name, or not."""

    folder: Path
    out: Path
    settings: Settings
    rows: dict = field(default_factory=dict)

    def parts(self):
        names = sorted(p.name for p in self.folder.iterdir() if p.is_file() and p.suffix.lower() in EXTENSIONS)
        names = [name for name in names if not name.startswith(".") and not name.endswith(REPORT)]
        if not names:
            sys.exit(f"There are no parts in {self.folder}: their names end in one of {', '.join(EXTENSIONS)}.")
        twice = [stem for stem, count in Counter(Path(name).stem for name in names).items() if count > 1]
        if twice:
            both = " and ".join(name for name in names if Path(name).stem == twice[0])
            sys.exit(f"{both} would have meshes of the same name: rename one of them.")
        return names

    def read_reports(self, names):
        """Reads the rows of earlier runs. Returns the parts that are still to be done."""
        saved = {name: self.saved(name) for name in names}
        self.rows = {name: one["row"] for name, one in saved.items() if one is not None}
        return [name for name in names if not self.is_done(name, saved[name])]

    def saved(self, name):
        try:
            return json.loads(self.path(name, REPORT).read_text())
        except (OSError, ValueError):
            return None

    def is_done(self, name, saved):
        """Returns whether a part has a mesh that was made of this file with these options."""
        if not self.is_current(name, saved) or saved["row"]["status"] != "done":
            return False
        return self.path(name, self.settings.extension).exists()

    def is_current(self, name, saved):
        """Returns whether a report, of a success or a failure, is about this file with these options."""
        return saved is not None and saved["of"] == self.state_of(name)

    def state_of(self, name):
        stat = (self.folder / name).stat()
        return {"bytes": stat.st_size, "changed": stat.st_mtime_ns, "options": list(self.settings.options)}

    def read(self, name):
        return self.state_of(name), (self.folder / name).read_bytes()

    def save(self, name, state, result):
        """Writes the mesh, then the report, which marks the part as done."""
        row, mesh = result["row"], self.path(name, self.settings.extension)
        for end, content in result["files"].items():
            write(self.path(name, end), content)
        if row["status"] == "done":
            row["mesh"] = mesh.name
        else:
            mesh.unlink(missing_ok=True)
        saved = {"row": row, "of": state, "report": result["report"]}
        write(self.path(name, REPORT), json.dumps(saved, indent=1).encode())
        self.rows[name] = row
        print(f"{name}: {row['reason'] or str(row['tetrahedra']) + ' tetrahedra'}", flush=True)

    def write_table(self):
        text = io.StringIO()
        table = csv.DictWriter(text, COLUMNS, extrasaction="ignore", lineterminator="\n")
        table.writeheader()
        table.writerows(self.rows[name] for name in sorted(self.rows))
        write(self.out / TABLE, text.getvalue().encode())

    def path(self, name, end):
        return self.out / f"{Path(name).stem}{end}"

    def remove_pieces(self):
        """Removes what a run that was killed had begun to write."""
        for piece in self.out.glob(".*.piece"):
            piece.unlink(missing_ok=True)


def write(path, content):
    """Writes a file under another name and renames it: whoever reads it, also after a kill, reads all of it."""
    piece = path.with_name(f".{path.name}.{socket.gethostname()}-{os.getpid()}.piece")
    with piece.open("wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    piece.replace(path)


def failed_result(name, reason):
    return {"row": {"part": name, "status": "failed", "reason": reason}, "report": None, "files": {}}


# Ray.


def run_on_ray(todo, store, address, tries):
    """Meshes parts on the machines of a cluster, or on the processors of this machine."""
    ray = connected(address)
    settings = store.settings
    check_machines(ray, settings)
    for name in todo:
        store.rows.pop(name, None)

    # Ray would try again silently; here every try is counted.
    @ray.remote(num_cpus=settings.cpus, memory=settings.memory, max_retries=0)
    def on_machine(name, content, settings):
        result = mesh_part(name, content, settings)
        result["row"]["node"] += f" {ray.get_runtime_context().get_node_id()[:8]}"
        return result

    waiting, running, begun = deque(todo), {}, Counter()
    next_table = 0.0
    while waiting or running:
        while waiting and len(running) < slots(ray, settings) + AHEAD:
            name = waiting.popleft()
            begun[name] += 1
            try:
                state, content = store.read(name)
            except OSError as failure:
                store.save(name, {}, failed_result(name, str(failure)))
                continue
            running[on_machine.remote(name, content, settings)] = name, state
        (ended, *_), _ = ray.wait(list(running))
        name, state = running.pop(ended)
        try:
            result = ray.get(ended)
        except ray.exceptions.RayTaskError as failure:
            result = failed_result(name, str(failure.cause))
        except ray.exceptions.RayError as failure:
            print(f"{name}: {in_words(failure)} on try {begun[name]} of {tries}", flush=True)
            if begun[name] < tries:
                waiting.append(name)
                continue
            result = failed_result(name, f"{in_words(failure)}, {tries} times")
        result["row"]["tries"] = begun[name]
        store.save(name, state, result)
        if time.monotonic() > next_table:
            store.write_table()
            next_table = time.monotonic() + SECONDS_BETWEEN_TABLES


def connected(address):
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    try:
        import ray
    except ImportError:
        sys.exit("Ray is not installed for this Python: pip install ray (or use --slurm, which does not need it).")
    try:
        ray.init(address=address or "local", log_to_driver=False, logging_level="error")
    except ConnectionError as failure:
        sys.exit(f"There is no Ray cluster at {address}: {failure}")
    return ray


def check_machines(ray, settings):
    """Ends the program if no machine is large enough for a part: Ray would wait for one without end."""
    machines = [node["Resources"] for node in ray.nodes() if node["Alive"]]
    if any(one.get("CPU", 0) >= settings.cpus and one.get("memory", 0) >= settings.memory for one in machines):
        return
    most = max((one.get("memory", 0) for one in machines), default=0)
    cpus = max((one.get("CPU", 0) for one in machines), default=0)
    sys.exit(
        f"No machine has {settings.cpus} free processors and {settings.memory // MIB} MB for a part; the largest "
        f"has {cpus:g} and {most // MIB:g} MB. Lower --cpus or --memory."
    )


def slots(ray, settings):
    """Returns how many parts the machines that are there can mesh at once."""
    resources = ray.cluster_resources()
    by_cpus = resources.get("CPU", 0) // settings.cpus
    return int(min(by_cpus, resources.get("memory", 0) // settings.memory))


def in_words(failure):
    kind = type(failure).__name__
    if "OutOfMemory" in kind:
        return "ended by Ray, because its machine was out of memory"
    return f"its machine or its process died ({kind})"


# Slurm.


def slurm_script(todo, store):
    """Returns a job array that meshes the parts, several per element if they are many."""
    settings = store.settings
    elements = min(len(todo), LARGEST_ARRAY)
    per_element = -(-len(todo) // elements)
    minutes = math.ceil(per_element * settings.seconds / 60) + 1
    this = [sys.executable, str(Path(__file__).resolve()), str(store.folder), str(store.out)]
    limits = ["--memory", f"{settings.memory // MIB}M", "--minutes", f"{settings.seconds / 60:g}"]
    how = ["--to", settings.extension[1:], "--command", shlex.join(settings.command)]
    options = ["--", *settings.options] if settings.options else []
    names = "\n".join(f"  {shlex.quote(name)}" for name in todo)
    return f"""#!/bin/bash
# Meshes {len(todo)} parts: sbatch this file. The element that ends last writes the table. If some were lost:
# {shlex.join([*this, "--table"])}
#SBATCH --job-name=mesh_parts
#SBATCH --array=0-{elements - 1}
#SBATCH --cpus-per-task={settings.cpus}
#SBATCH --mem={settings.memory // MIB + SLURM_MARGIN_MB}M
#SBATCH --time={minutes}
#SBATCH --requeue
parts=(
{names}
)
code=0
for ((i = SLURM_ARRAY_TASK_ID; i < ${{#parts[@]}}; i += {elements})); do
  {shlex.join([*this, *limits, *how])} --part "${{parts[i]}}" {shlex.join(options)} || code=1
done
exit $code
"""


def run_here(name, store):
    """Meshes one part without Ray, as an element of a job array does."""
    if not store.is_done(name, store.saved(name)):
        state = {}
        try:
            state, content = store.read(name)
            result = mesh_part(name, content, store.settings)
        except OSError as failure:
            result = failed_result(name, str(failure))
        result["row"]["tries"] = 1
        store.save(name, state, result)
    names = store.parts()
    if all(store.is_current(other, store.saved(other)) for other in names):
        store.read_reports(names)
        store.write_table()
    return 0 if store.saved(name)["row"]["status"] == "done" else 1


# The command line of this program.


def memory_in(text):
    """Reads 900M or 4G."""
    number, unit = text[:-1], text[-1:].upper()
    if unit not in ("M", "G") or not number.isdigit() or int(number) == 0:
        raise argparse.ArgumentTypeError(f'"{text}" is no amount of memory, such as 900M or 4G')
    return int(number) * (MIB if unit == "M" else 1024 * MIB)


def arguments_in(given):
    own, options = given, []
    if "--" in given:
        own, options = given[: given.index("--")], given[given.index("--") + 1 :]
    parser = argparse.ArgumentParser(
        description="Meshes every part of a folder on a Ray cluster, or as a Slurm job array.",
        epilog="Options of `tetrafront mesh` follow after --, for example: -- --size 0.5 --element-order 2",
    )
    add = parser.add_argument
    add("folder", type=Path, help=f"parts: {' '.join(EXTENSIONS)}")
    add("out", type=Path, help="folder of the meshes, their reports, and the table parts.csv")
    add("--address", help="address of a Ray cluster (default: this machine)")
    add("--memory", type=memory_in, default="2G", help="limit per part (default 2G)")
    add("--minutes", type=float, default=60, help="limit per part (default 60)")
    add("--cpus", type=int, default=1, help="processors per part (default 1)")
    add("--tries", type=int, default=5, help="how often a part is begun if its machine dies (default 5)")
    add("--to", default="vtu", help="format of the meshes, by its extension (default vtu)")
    add("--command", default="tetrafront", help="how Tetrafront is called on each machine (default tetrafront)")
    add("--slurm", action="store_true", help="print a script for sbatch instead")
    add("--table", action="store_true", help="only write the table of the reports that are there")
    add("--part", help="mesh only this part, here and without Ray")
    return parser.parse_args(own), options


def main(given):
    arguments, options = arguments_in(given)
    folder, out = arguments.folder.resolve(), arguments.out.resolve()
    if not folder.is_dir():
        sys.exit(f"There is no folder {folder}.")
    out.mkdir(parents=True, exist_ok=True)
    settings = Settings(
        command=tuple(shlex.split(arguments.command)),
        options=tuple(options),
        extension=f".{arguments.to}",
        memory=arguments.memory,
        seconds=60 * arguments.minutes,
        cpus=arguments.cpus,
    )
    store = Store(folder, out, settings)
    if arguments.part is not None:
        return run_here(arguments.part, store)
    names = store.parts()
    todo = store.read_reports(names)
    if arguments.slurm and todo:
        print(slurm_script(todo, store), end="")
        return 0
    if todo and not arguments.table:
        store.remove_pieces()
        run_on_ray(todo, store, arguments.address, arguments.tries)
    store.write_table()
    done = sum(row["status"] == "done" for row in store.rows.values())
    print(f"{len(names)} parts: {done} done, {len(store.rows) - done} failed; see {out / TABLE}", file=sys.stderr)
    return 0 if done == len(names) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
