"""A participant of a Standoff run in plain Python: what proto/README.md says, nothing of Standoff's own code.

Needs python3-zmq, python3-protobuf, python3-numpy and protoc (protobuf-compiler). Copy it to begin a program of your own.
"""
import functools
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import time

import numpy
import zmq

PROTO = pathlib.Path(__file__).resolve().parents[3] / "proto"
MAGIC, VERSION = 0x4F445453, 1


def generated_messages():
    """The classes that protoc makes of proto/*.proto, imported from a folder that is gone again afterwards."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["protoc", f"-I{PROTO}", f"--python_out={folder}", *map(str, PROTO.glob("*.proto"))], check=True)
        sys.path.insert(0, folder)
        import envelope_pb2
        import session_pb2
        sys.path.remove(folder)
    return envelope_pb2, session_pb2


wire, session = generated_messages()


def zero_bit_table():
    table = numpy.arange(256, dtype=numpy.uint32)
    for _ in range(8):
        table = numpy.where(table & 1, (table >> 1) ^ numpy.uint32(0x82F63B78), table >> 1)
    return table


TABLE = zero_bit_table()


@functools.lru_cache
def tables_after_zeros(count):
    """What `count` zero bytes make of each of the four bytes of a remainder."""
    crc = numpy.arange(256, dtype=numpy.uint32) << (8 * numpy.arange(4, dtype=numpy.uint32)[:, None])
    for _ in range(count):
        crc = TABLE[crc & 255] ^ (crc >> 8)
    return crc.tolist()


def crc32c(data):
    """CRC-32C of at least four bytes: equal stretches side by side, then joined. Zeros in front change nothing."""
    raw = bytearray(data)
    for i in range(4):
        raw[i] ^= 0xFF
    length = int(len(raw) ** 0.5) + 1
    stretches = numpy.frombuffer(bytes(-len(raw) % length) + raw, dtype=numpy.uint8).reshape(-1, length)
    crc = numpy.zeros(len(stretches), dtype=numpy.uint32)
    for column in stretches.T:
        crc = TABLE[(crc ^ column) & 255] ^ (crc >> 8)
    t0, t1, t2, t3 = tables_after_zeros(length)
    total = 0
    for part in crc.tolist():
        total = t0[total & 255] ^ t1[total >> 8 & 255] ^ t2[total >> 16 & 255] ^ t3[total >> 24] ^ part
    return total ^ 0xFFFFFFFF


class RunFailed(Exception):
    """The run has ended early: exit code and first cause, which everyone prints."""

    def __init__(self, code, text, tell=None):
        super().__init__(text)
        self.code, self.tell = code, tell  # tell: the reason to send as ABORT; None: the others know


class Structure:
    """The structure's side of a run, one method a step of the life cycle."""

    def __init__(self, endpoint, token, name="structure"):
        self.name, self.token, self.nodes = name, token, 0
        self.epoch = self.sent = self.heard = self.progress = 0
        self.window, self.beat_interval, self.beat_deadline = -1, 1.0, 60.0
        self.wait = self.compute = 0.0
        self.context = zmq.Context()
        self.socket = self.context.socket(zmq.DEALER)
        self.socket.linger = 1000
        self.socket.connect(endpoint)
        signal.signal(signal.SIGTERM, self.interrupted)
        signal.signal(signal.SIGINT, self.interrupted)
        self.say("hello", session.Hello(name=name, role=session.STRUCTURE, software_version="python",
                                        pid=os.getpid(), host=socket.gethostname()))
        welcome = self.hear("welcome")[0].welcome
        self.epoch, self.beat_interval, self.beat_deadline = welcome.epoch, welcome.beat_interval, welcome.beat_deadline

    def interrupted(self, number, _frame):
        text = f"interrupted by {signal.Signals(number).name}"
        raise RunFailed(130, f"first cause: {self.name}, window {self.window}: {text}", text)

    def offer_surface(self, position, quads, node_mass):
        fields = [self.field("position", position, "<f8", 3), self.field("quads", quads, "<i4", 4),
                  self.field("node_mass", node_mass, "<f8", 1)]
        self.nodes = len(position)
        self.digest = "".join(f"{field.checksum:08x}" for field, _ in fields)
        self.say("surface", wire.Envelope().surface.__class__(nodes=len(position), quads=len(quads), digest=self.digest),
                 fields)

    def ready(self, stable_step):
        self.say("ready", session.Ready(stable_step=stable_step, surface_digest=self.digest))
        return self.hear("start")[0].start

    def windows(self):
        """GRANT and the force on the nodes, window after window, until STOP."""
        while True:
            envelope, frames = self.hear("grant", "stop")
            if envelope.WhichOneof("body") == "stop":
                return
            self.window = envelope.grant.window
            force, self.granted = self.take_force(envelope, frames), time.monotonic()
            yield envelope.grant, force

    def advance(self, position, velocity, impulse, work):
        self.compute += time.monotonic() - self.granted
        self.progress += 1
        message = session.Advance(window=self.window, compute=self.compute, wait=self.wait)
        message.totals.impulse.extend(impulse)
        message.totals.work = work
        self.say("advance", message, [self.field("position", position, "<f8", 3),
                                      self.field("velocity", velocity, "<f8", 3)])

    def sample(self, moment, values):
        sample = wire.Envelope().sample.__class__(time=moment)
        for key, value in values.items():
            sample.values.add(name=key, value=value)
        self.say("sample", sample)

    def finish(self, report_json):
        self.say("report", wire.Envelope().report.__class__(json=report_json))
        self.say("bye", session.Bye())
        self.hear("bye_ack")

    def abort(self, code, reason):
        self.say("abort", session.Abort(origin=self.name, code=code, reason=reason.encode(), window=self.window))

    def say(self, kind, body, fields=()):
        self.sent += 1
        envelope = wire.Envelope(magic=MAGIC, wire_version=VERSION, token=self.token, epoch=self.epoch,
                                 sequence=self.sent, sender=self.name, window=self.window,
                                 fields=[field for field, _ in fields], **{kind: body})
        self.socket.send_multipart([envelope.SerializeToString(), *(frame for _, frame in fields)])
        self.last_said = time.monotonic()

    def hear(self, *wanted):
        """The next message that is not a heartbeat; beats meanwhile, and ends on ABORT, silence and nonsense."""
        begin = last_heard = time.monotonic()
        while True:
            if self.socket.poll(50):
                envelope, frames = self.receive()
                last_heard = time.monotonic()
                kind = envelope.WhichOneof("body")
                if kind in wanted:
                    self.wait += last_heard - begin
                    return envelope, frames
                if kind != "beat":
                    self.broken(f"{kind} when {wanted[0]} was due")
            now = time.monotonic()
            if now - last_heard > self.beat_deadline:
                raise RunFailed(4, f"first cause: broker: no sign of life for {self.beat_deadline:g} s")
            if self.epoch and now - self.last_said >= self.beat_interval:
                self.say("beat", session.Beat(progress=self.progress))

    def receive(self):
        first, *frames = self.socket.recv_multipart()
        try:
            envelope = wire.Envelope.FromString(first)
        except Exception:
            self.broken("the first frame is not an envelope")
        if envelope.magic != MAGIC or envelope.wire_version != VERSION:
            self.broken(f"wire version {envelope.wire_version} where this program speaks {VERSION}")
        kind = envelope.WhichOneof("body")
        if kind == "abort":
            at = f", window {envelope.abort.window}" if envelope.abort.window >= 0 else ""
            reason = envelope.abort.reason.decode(errors="replace")
            raise RunFailed(envelope.abort.code, f"first cause: {envelope.abort.origin}{at}: {reason}")
        if kind == "reject":
            reject = envelope.reject
            raise RunFailed(reject.code, f'first cause: broker: rejected "{self.name}": {reject.reason}; {reject.remedy}')
        self.heard += 1
        if envelope.token != self.token or envelope.sequence != self.heard:
            self.broken(f"{kind} has sequence number {envelope.sequence}, expected {self.heard}, or another run token")
        return envelope, frames

    def field(self, name, values, kind, components):
        data = numpy.ascontiguousarray(values, dtype=kind)
        if kind == "<f8" and not numpy.isfinite(data).all():
            raise RunFailed(3, f"first cause: {self.name}, window {self.window}: {name} is not finite",
                            f"{name} is not finite: the structure is unstable")
        frame = data.tobytes()
        return wire.Field(name=name, data_type=wire.F64 if kind == "<f8" else wire.I32, components=components,
                          count=data.size // components, byte_length=len(frame), checksum=crc32c(frame)), frame

    def take_force(self, envelope, frames):
        if not envelope.fields and not frames:
            return numpy.zeros((self.nodes, 3))
        if len(envelope.fields) != 1 or len(frames) != 1:
            self.broken(f"{len(envelope.fields)} fields announced, {len(frames)} frames")
        field, size = envelope.fields[0], 24 * self.nodes
        shape = (field.name, field.data_type, field.components, field.count, field.byte_length, len(frames[0]))
        if shape != ("force", wire.F64, 3, self.nodes, size, size):
            self.broken(f"force announces {shape}, expected {self.nodes} x 3 values, {size} bytes")
        if crc32c(frames[0]) != field.checksum:
            self.broken("force does not have the checksum its sender announced")
        force = numpy.frombuffer(frames[0], dtype="<f8").reshape(-1, 3)
        if not numpy.isfinite(force).all():
            self.broken("force is not finite")
        return force

    def broken(self, reason):
        text = f"broke the protocol: {reason}"
        raise RunFailed(4, f"first cause: broker: {text}", text)


def participant(body, endpoint, token):
    """Runs body(link) and returns the exit code; what goes wrong is told to the others, then to the user."""
    link = None
    try:
        link = Structure(endpoint, token)
        body(link)
        return 0
    except RunFailed as failure:
        if failure.tell and link is not None:
            link.abort(failure.code, failure.tell)
        print(f"{pathlib.Path(sys.argv[0]).name}: error: {failure}", file=sys.stderr)
        return failure.code
    except Exception as error:  # a mistake in the model must not leave the others waiting
        if link is not None:
            link.abort(3, f"{type(error).__name__}: {error}")
        raise
