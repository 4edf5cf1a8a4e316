"""A Slurm cluster of a few nodes on this machine, for tests: munged, slurmctld and one slurmd for each node, without
systemd, with ports and files of their own. Closing it ends all of its processes, those of jobs included.
"""

import ctypes
import getpass
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scancel", "scontrol", "sinfo", "squeue")
# Debian keeps the daemons where not every user's PATH leads.
PATH = f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin"
# The controller gives up a node that is silent for this long. Slurm's default is 300 s.
SECONDS_TO_NODE_FAILURE = 5
PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36

CONFIGURATION = """\
ClusterName=rastercheck
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/controller
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/controller.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldPort={port}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=sched_min_interval=100000,bf_interval=1
MessageTimeout=4
TCPTimeout=1
SlurmctldTimeout=15
SlurmdTimeout={silence}
InactiveLimit=0
JobRequeue=0
KillWait=3
MinJobAge=3600
SlurmdParameters=config_overrides
"""
NODE = "NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=2 RealMemory=4000 State=UNKNOWN\n"
PARTITION = "PartitionName=all Nodes={names} Default=YES MaxTime=INFINITE State=UP\n"


def missing_programs():
    return [name for name in PROGRAMS if shutil.which(name, path=PATH) is None]


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def wait_until(is_true, what, seconds=120, pause=0.02):
    """Returns the first true value of is_true()."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = is_true()
        if value:
            return value
        time.sleep(pause)
    raise TimeoutError(f"{what}: not within {seconds} s")


class Process:
    """A process of this machine, by its files in /proc. Those of an ended process are empty."""

    def __init__(self, pid):
        self.pid = pid

    def read(self, name):
        try:
            return pathlib.Path(f"/proc/{self.pid}/{name}").read_bytes()
        except OSError:
            return b""

    def statistic(self, number):
        """A number of /proc/PID/stat, counted from the one after the name, which is in parentheses; 0 after the end."""
        fields = self.read("stat").rpartition(b")")[2].split()
        return int(fields[number]) if fields else 0

    def parent(self):
        return self.statistic(1)

    def seconds(self):
        """The processor time that it has used."""
        return self.statistic(11) / os.sysconf("SC_CLK_TCK")

    def name(self):
        return self.read("comm").decode(errors="replace").strip()

    def words(self):
        return self.read("cmdline").decode(errors="replace").split("\0")[:-1]

    def environment(self):
        return dict(entry.partition("=")[::2] for entry in self.read("environ").decode(errors="replace").split("\0"))

    def signal(self, number):
        try:
            os.kill(self.pid, number)
        except ProcessLookupError:
            pass


def descendants():
    """All processes that this one started, and those that these started."""
    processes = [Process(int(path.name)) for path in pathlib.Path("/proc").iterdir() if path.name.isdigit()]
    children = {}
    for process in processes:
        children.setdefault(process.parent(), []).append(process)
    found, ancestors = [], [os.getpid()]
    while ancestors:
        born = children.get(ancestors.pop(), [])
        found += born
        ancestors += [process.pid for process in born]
    return found


class Cluster:
    def __init__(self, folder, nodes, environment):
        """Starts a cluster with nodes of these names. Jobs get the environment's variables."""
        self.folder, self.nodes = pathlib.Path(folder), list(nodes)
        self.configuration = self.folder / "slurm.conf"
        self.environment = {**environment, "PATH": f"{environment['PATH']}:{PATH}",
                            "SLURM_CONF": str(self.configuration)}
        self.libc = ctypes.CDLL(None, use_errno=True)
        # The daemons' children, which outlive them, become ours instead of init's. So none gets lost.
        self.libc.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        self.daemons = {}

    def start(self):
        host = socket.gethostname().partition(".")[0]
        port, *ports = free_ports(1 + len(self.nodes))
        text = CONFIGURATION.format(host=host, user=getpass.getuser(), folder=self.folder, port=port,
                                    silence=SECONDS_TO_NODE_FAILURE)
        for name, its_port in zip(self.nodes, ports):
            text += NODE.format(name=name, host=host, port=its_port)
            (self.folder / name).mkdir()
        text += PARTITION.format(names=",".join(self.nodes))
        self.configuration.write_text(text, encoding="utf-8")
        (self.folder / "controller").mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        self.daemon("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.socket",
                    f"--pid-file={self.folder}/munge.pid", f"--log-file={self.folder}/munge.log",
                    f"--seed-file={self.folder}/munge.seed")
        wait_until((self.folder / "munge.socket").exists, "munged")
        self.daemon("slurmctld", "-D", "-f", self.configuration)
        for name in self.nodes:
            self.daemon("slurmd", "-D", "-N", name, "-f", self.configuration, name=name)
        wait_until(lambda: self.states() == {name: "idle" for name in self.nodes}, "idle nodes", pause=0.1)

    def daemon(self, program, *words, name=None):
        """Starts a daemon that ends with this process, even if this one is killed."""
        name = name or program
        with open(self.folder / f"{name}.out", "wb") as log:
            self.daemons[name] = subprocess.Popen(  # pylint: disable=consider-using-with
                [shutil.which(program, path=PATH), *map(str, words)], env=self.environment, stdin=subprocess.DEVNULL,
                stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
                preexec_fn=lambda: self.libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0))

    def command(self, *words, folder=None, code=0):
        done = subprocess.run([str(word) for word in words], env=self.environment, cwd=folder, capture_output=True,
                              text=True, check=False)
        if code is not None and done.returncode != code:
            raise RuntimeError(f"{words}: exit code {done.returncode}\n{done.stdout}{done.stderr}{self.logs()}")
        return done

    def states(self):
        done = self.command("sinfo", "--noheader", "--Node", "--format=%N %t", code=None)
        return dict(line.split() for line in done.stdout.splitlines())

    def jobs(self):
        """The states of the jobs and array tasks that have not ended, by their names: {"5_17": "RUNNING"}."""
        done = self.command("squeue", "--noheader", "--array", "--format=%i %T", code=None)
        return dict(line.split() for line in done.stdout.splitlines())

    def logs(self):
        parts = []
        for path in sorted(self.folder.glob("*.out")):
            lines = path.read_text(errors="replace").splitlines()
            parts += [f"--- {path.name}", *lines[-15:]]
        return "\n".join(parts)

    def on_nodes(self, names):
        """The processes of the jobs on these nodes."""
        return [process for process in descendants() if process.environment().get("SLURMD_NODENAME") in names]

    def fail_node(self, name):
        """What a power failure would do: ends the node's daemon and all of its jobs at once."""
        of_jobs = self.on_nodes([name])
        managers = [Process(process.parent()) for process in of_jobs]
        daemon = self.daemons.pop(name)
        daemon.kill()
        daemon.wait()
        for process in [one for one in managers if one.name() == "slurmstepd"] + of_jobs:
            process.signal(signal.SIGKILL)

    def close(self):
        for daemon in self.daemons.values():
            daemon.kill()
            daemon.wait()
        while True:  # a process may start another one meanwhile
            left = descendants()
            for process in left:
                process.signal(signal.SIGKILL)
            try:
                while os.waitpid(-1, os.WNOHANG if left else 0)[0]:
                    pass
            except ChildProcessError:
                break
            time.sleep(0.01)
        self.libc.prctl(PR_SET_CHILD_SUBREAPER, 0, 0, 0, 0)
