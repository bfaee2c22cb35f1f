#!/usr/bin/python3
"""The membrane with three sins, to show that the conformance suite finds them: it takes any checksum for good, counts only
half of the impulse it receives, and ends with 1 on SIGTERM without a word to the others."""
import signal
import sys

import membrane
import wire


class Careless(wire.Structure):
    def __init__(self, endpoint, token):
        super().__init__(endpoint, token)
        signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(1))

    def take_force(self, envelope, frames):
        for field, frame in zip(envelope.fields, frames):
            field.checksum = wire.crc32c(frame)
        return super().take_force(envelope, frames)

    def advance(self, position, velocity, impulse, work):
        super().advance(position, velocity, 0.5 * impulse, work)


wire.Structure = Careless
sys.exit(membrane.main())
