# SPDX-License-Identifier: Apache-2.0
"""A Slurm of this machine alone, with its own key, ports and folder, for as long as a test runs."""
import os
import pathlib
import pwd
import shutil
import socket
import subprocess
import tempfile
import time

DAEMONS = ("munged", "slurmctld", "slurmd")
CONFIGURATION = """\
ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={control_port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus}
PartitionName=all Nodes={host} Default=YES MaxTime=10 State=UP
"""


def daemon(name):
    """Where Debian puts it: /usr/sbin is not on everybody's PATH."""
    return shutil.which(name) or shutil.which(name, path="/usr/sbin")


def is_installed():
    return all(daemon(name) for name in DAEMONS) and shutil.which("sbatch") is not None


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class OneNodeSlurm:
    """`with OneNodeSlurm() as environment:` what sbatch and its like need in their environment."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="one-node-"))
        self.running = []

    def __enter__(self):
        try:
            return self.start()
        except BaseException:
            self.__exit__()
            raise

    def __exit__(self, *_):
        for process in reversed(self.running):
            process.terminate()
        for process in self.running:
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def start(self):
        # munged refuses keys that others can read and sockets that others cannot reach.
        os.chmod(self.folder, 0o755)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        control_port, node_port = free_ports(2)
        configuration = self.folder / "slurm.conf"
        configuration.write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], user=pwd.getpwuid(os.getuid()).pw_name,
            control_port=control_port, node_port=node_port, folder=self.folder, cpus=os.cpu_count()))
        environment = dict(os.environ, SLURM_CONF=str(configuration))

        files = [f"--{name}-file={self.folder}/munge.{name}" for name in ("key", "seed", "log", "pid")]
        self.run(environment, daemon("munged"), "--foreground", "--force",
                 f"--socket={self.folder}/munge.socket", *files)
        self.wait_for(lambda: (self.folder / "munge.socket").exists(), "munged")
        self.run(environment, daemon("slurmctld"), "-D")
        self.run(environment, daemon("slurmd"), "-D")
        self.wait_for(lambda: subprocess.run(["sinfo", "--noheader", "--format=%t"], env=environment, text=True,
                                             capture_output=True).stdout.strip() == "idle", "the node")
        return environment

    def run(self, environment, *command):
        self.running.append(subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL,
                                             stderr=subprocess.DEVNULL))

    def wait_for(self, ready, what, seconds=60):
        end = time.monotonic() + seconds
        while not ready():
            if time.monotonic() > end:
                logs = "".join(p.read_text(errors="replace")[-2000:] for p in self.folder.glob("*.log"))
                raise RuntimeError(f"{what} is not up after {seconds} s\n{logs}")
            time.sleep(0.1)
