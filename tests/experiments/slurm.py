"""A Slurm cluster of one machine, for as long as a `with` block lasts: munged, slurmctld and slurmd with folders, ports, key and
sockets of their own in a temporary directory. Nothing of the system's configuration is read or changed."""

import contextlib
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ["munged", "slurmctld", "slurmd", "sinfo", "sbatch"]
CONFIGURATION = """
ClusterName=experiments
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={controller_port}
SlurmdPort={node_port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def missing():
    """Why Slurm cannot run here; empty where it can."""
    search = os.environ["PATH"] + ":/usr/sbin"
    absent = [program for program in PROGRAMS if shutil.which(program, path=search) is None]
    if absent:
        return f"not installed: {', '.join(absent)}"
    return "" if os.geteuid() == 0 else "slurmd starts jobs as other users, so it needs root"


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for entry in sockets:
            entry.bind(("127.0.0.1", 0))
        return [entry.getsockname()[1] for entry in sockets]


def wait_for(condition, what, seconds=30):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(f"{what}: not within {seconds} s")
        time.sleep(0.1)


def node_is_idle(environment):
    done = subprocess.run(["sinfo", "--noheader", "--format=%T"], env=environment, capture_output=True, text=True, check=False)
    return done.returncode == 0 and done.stdout.strip() == "idle"


def stop(process):
    """The daemon and what it has started."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGTERM)
    try:
        process.wait(timeout=10)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


@contextlib.contextmanager
def cluster(cpus):
    """Yields the environment in which Slurm's commands reach the cluster. Raises TimeoutError, with the daemons' logs, if it does
    not start."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="vsgl-slurm-"))
    folder.chmod(0o755)  # munge's socket wants folders that anybody may enter
    processes = []

    def start(*command):
        with open(folder / f"{command[0]}.out", "w", encoding="utf-8") as output:
            environment = dict(os.environ, PATH=os.environ["PATH"] + ":/usr/sbin", SLURM_CONF=str(folder / "slurm.conf"))
            processes.append(subprocess.Popen(command, env=environment, stdout=output, stderr=output, start_new_session=True))

    try:
        controller_port, node_port = free_ports(2)
        host = socket.gethostname().split(".")[0]
        text = CONFIGURATION.format(folder=folder, host=host, cpus=cpus, controller_port=controller_port, node_port=node_port)
        (folder / "slurm.conf").write_text(text, encoding="utf-8")
        key = folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(secrets.token_bytes(128))
        for name in ("state", "spool"):
            (folder / name).mkdir()
        start("munged", "--foreground", f"--socket={folder}/munge.socket", f"--key-file={key}", f"--pid-file={folder}/munge.pid",
              f"--log-file={folder}/munge.log", f"--seed-file={folder}/munge.seed")
        wait_for((folder / "munge.socket").exists, "munged")
        start("slurmctld", "-D", "-i", "-f", str(folder / "slurm.conf"))
        start("slurmd", "-D", "-N", host, "-f", str(folder / "slurm.conf"))
        environment = dict(os.environ, SLURM_CONF=str(folder / "slurm.conf"))
        wait_for(lambda: node_is_idle(environment), "Slurm's node")
        yield environment
    except TimeoutError as error:
        logs = "\n".join(f"{path.name}: {path.read_text(encoding='utf-8', errors='replace')[-2000:]}"
                         for path in sorted(folder.glob("*.out")) + sorted(folder.glob("*.log")))
        raise TimeoutError(f"{error}\n{logs}") from error
    finally:
        for process in reversed(processes):
            stop(process)
        shutil.rmtree(folder)
