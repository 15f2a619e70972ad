"""Draws of a study by a ChaCha of its own, for `draws_stay_what_they_are` of src/streams.rs.

D. J. Bernstein, ChaCha, a variant of Salsa20 (2008): a block of 16 words from a key, a counter and a stream.
"""

import struct

MASK = 2**32 - 1


def block(key: bytes, counter: int, stream: int, rounds: int = 8) -> bytes:
    start = list(struct.unpack("<16I", b"expand 32-byte k" + key + struct.pack("<QQ", counter, stream)))
    x = start[:]

    def quarter(a, b, c, d):
        for i, j, k, turn in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
            x[i] = (x[i] + x[j]) & MASK
            x[k] ^= x[i]
            x[k] = ((x[k] << turn) | (x[k] >> (32 - turn))) & MASK

    for _ in range(rounds // 2):
        for column in range(4):
            quarter(column, column + 4, column + 8, column + 12)
        for i in range(4):
            quarter(i, (i + 1) % 4 + 4, (i + 2) % 4 + 8, (i + 3) % 4 + 12)
    return struct.pack("<16I", *((a + b) & MASK for a, b in zip(x, start)))


def fnv(name: str) -> int:
    value = 0x6C62272E07BB014262B821756295C58D
    for byte in name.encode():
        value = (value ^ byte) * 0x13B + ((value ^ byte) << 88) & (2**128 - 1)
    return value


def bits(seed: int, name: str, run: int) -> int:
    key = struct.pack("<QQ", seed, 0) + fnv(name).to_bytes(16, "little")
    return int.from_bytes(block(key, 0, run)[:8], "little")


if __name__ == "__main__":
    # draft-strombergson-chacha-test-vectors-01, TC1: the block itself is right.
    assert block(bytes(32), 0, 0).hex().startswith("3e00ef2f895f40d67f5bb8e81f09a5a12c840ec3ce9a7f3b181be188ef711a1e")
    print([hex(bits(seed, "slope", run)) for seed, run in ((1, 0), (1, 1), (2, 0), (1, 2**40))])
