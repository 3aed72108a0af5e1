# SPDX-License-Identifier: Apache-2.0
"""What a disk may hold after a loss of power, by POSIX's rules.

The program with faults (tests/faults) writes down each call that changes a file or folder. A Disk follows that list. What
was written to a file before its last fsync is there. Each sector that was written after it has any one of the contents that
it had since, whatever came of the others: writes are dropped, torn and reordered. A sector that the file did not have at its
last fsync may hold rubbish. The file's length is any that it had since. Each change of a folder since its last fsync is there
or not, for itself; a rename or link brings the inode along.
"""
import os
import random
import shutil

SECTOR = 512
WAYS = ["nothing", "all", "first", "last", "any", "any", "any"]  # what came through; files and folders for themselves


class File:
    """`synced` is certain; `pending` are the changes since: (offset, bytes), or (length, None) of a truncation."""

    def __init__(self, content=b""):
        self.synced, self.pending, self.now = content, [], bytearray(content)

    def change(self, offset, data):
        self.pending.append((offset, data))
        apply(self.now, offset, data)

    def sync(self):
        self.synced, self.pending = bytes(self.now), []

    def after(self, way, chance):
        """A content that it may have."""
        if way == "nothing" or not self.pending:
            return self.synced
        if way == "all":
            return bytes(self.now)
        n = chance.randrange(len(self.pending) + 1)
        if way == "first":  # the first n changes, and a piece of the next
            content = bytearray(self.synced)
            for offset, data in self.pending[:n]:
                apply(content, offset, data)
            if n < len(self.pending) and self.pending[n][1]:
                offset, data = self.pending[n]
                apply(content, offset, data[:chance.randrange(0, len(data) + 1, SECTOR)])
            return bytes(content)
        if way == "last":  # the last ones without those before
            content = bytearray(self.synced)
            for offset, data in self.pending[n:]:
                apply(content, offset, data)
            return bytes(content)
        return self.mixed(chance)

    def mixed(self, chance):
        lengths, content, versions = [len(self.synced)], bytearray(self.synced), {}
        for offset, data in self.pending:
            before = len(content)
            apply(content, offset, data)
            first, end = (offset, offset + len(data)) if data is not None else (min(before, offset), max(before, offset))
            for sector in range(first // SECTOR, (end + SECTOR - 1) // SECTOR):
                versions.setdefault(sector, [self.before(sector, chance)]).append(
                    bytes(content[sector * SECTOR:(sector + 1) * SECTOR]).ljust(SECTOR, b"\0"))
            lengths.append(len(content))
        length = chance.choice(lengths + [lengths[-1]] * 4)
        new = bytearray(self.synced.ljust(length, b"\0"))
        often = chance.choice([0.1, 0.5, 0.9])
        for sector, contents in versions.items():
            came = contents[-1] if chance.random() < often else chance.choice(contents)
            new[sector * SECTOR:(sector + 1) * SECTOR] = came
        return bytes(new[:length])

    def before(self, sector, chance):
        old = self.synced[sector * SECTOR:(sector + 1) * SECTOR]
        if old or chance.random() < 0.5:
            return old.ljust(SECTOR, b"\0")
        return chance.randbytes(SECTOR)


def apply(content, offset, data):
    if data is None and offset < len(content):
        del content[offset:]
    elif data is None or offset > len(content):
        content.extend(bytes(offset - len(content)))
    if data is not None:
        content[offset:offset + len(data)] = data


class Folder:
    """Entries are inodes by name; a change is a list of (name, inode or None), which come through together."""

    def __init__(self, entries):
        self.synced, self.pending, self.now = dict(entries), [], dict(entries)

    def change(self, *entries):
        self.pending.append(entries)
        self.now.update(entries)

    def sync(self):
        self.synced, self.pending = dict(self.now), []

    def after(self, way, chance):
        n = chance.randrange(len(self.pending) + 1)
        kept = {"nothing": [], "all": self.pending, "first": self.pending[:n], "last": self.pending[n:],
                "any": [change for change in self.pending if chance.random() < 0.5]}[way]
        entries = dict(self.synced)
        for change in kept:
            entries.update(change)
        return {name: inode for name, inode in entries.items() if inode is not None}


class Disk:
    """All below the folder `root`, as it is now and on disk; then apply() what the log says."""

    def __init__(self, root):
        self.inodes = {}
        self.root = self.look(root)

    def copy(self):
        """The same disk before anything was applied."""
        new = Disk.__new__(Disk)
        new.root = self.root
        new.inodes = {inode: type(what)(what.synced) for inode, what in self.inodes.items()}
        return new

    def look(self, path):
        inode = str(os.stat(path).st_ino)
        if os.path.isdir(path):
            self.inodes[inode] = Folder({name: self.look(os.path.join(path, name)) for name in os.listdir(path)})
        else:
            with open(path, "rb") as stream:
                self.inodes[inode] = File(stream.read())
        return inode

    def apply(self, line):
        word, inode, *rest = line
        what = self.inodes.get(inode)
        if what is None:
            return  # not below the root
        if word in ("create", "mkdir"):
            self.inodes[rest[0]] = File() if word == "create" else Folder({})
            what.change((rest[1], rest[0]))
        elif word == "write":
            what.change(int(rest[0]), bytes.fromhex(rest[1]))
        elif word == "truncate":
            what.change(int(rest[0]), None)
        elif word == "sync":
            what.sync()
        elif word == "rename":
            what.change((rest[0], None), (rest[1], what.now[rest[0]]))
        elif word == "link":
            what.change((rest[1], rest[0]))
        elif word == "unlink":
            what.change((rest[0], None))
        elif word != "nothing":
            raise ValueError(word)

    def after(self, chance, files=None, folders=None):
        """A tree that may be there: {path: bytes, or None of a folder}."""
        tree = {}
        self.add(tree, "", self.root, chance, files or chance.choice(WAYS), folders or chance.choice(WAYS))
        return tree

    def add(self, tree, path, inode, chance, files, folders):
        what = self.inodes[inode]
        if isinstance(what, File):
            tree[path] = what.after(files, chance)
            return
        tree[path] = None
        for name, below in sorted(what.after(folders, chance).items()):
            self.add(tree, os.path.join(path, name), below, chance, files, folders)


def make(tree, root):
    """The tree in the file system."""
    shutil.rmtree(root, ignore_errors=True)
    for path, content in tree.items():
        if content is None:
            os.makedirs(os.path.join(root, path))
        else:
            with open(os.path.join(root, path), "wb") as stream:
                stream.write(content)


def read_log(path):
    with open(path, encoding="utf-8") as stream:
        return [line.split() for line in stream]
