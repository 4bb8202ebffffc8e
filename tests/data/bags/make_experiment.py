#!/usr/bin/env python3
"""Writes an experiment folder as the reference framework's record_experiment.sh leaves it (preset 2): a bag of sqlite3
without message definitions, param-files and git-hash.txt. Independent of scoria: CDR is packed here, by the .msg files.

    python3 make_experiment.py FOLDER

What is in it, for a calculation by hand (tests/app/analyze/reference_bag_test.cc): 50 Hz, 12 s. The robot walks along x at
0.5 m/s. Every joint swings with 0.05 rad at 2 Hz under a torque of 5 N m; the battery gives 4 A at 28 V. A trot: feet FL
and HR down for 0.24 s of each 0.4 s, the others 0.2 s later. At 7 s it rolls over within 0.5 s and lies until 9 s, when it
is found standing 1 m further on, and walks on.
"""
import math
import os
import sqlite3
import struct
import sys

RATE_HZ, LENGTH_S, SPEED_MPS = 50, 12.0, 0.5
FALL_S, LIE_S, PLACED_S = 7.0, 7.5, 9.0
MASS_KG, G_MPS2 = 15.019, 9.81
START_NS = 1_700_000_000 * 10**9
POSE = [0.0, 0.8, -1.6]  # abad, shoulder, knee


class Cdr:
    """Little-endian CDR: numbers are aligned to their size, counted from after the header of four bytes."""

    def __init__(self):
        self.data = bytearray(b"\x00\x01\x00\x00")

    def put(self, kind, *values):
        size = struct.calcsize(kind)
        for value in values:
            self.data += b"\x00" * (-(len(self.data) - 4) % size)
            self.data += struct.pack("<" + kind, value)

    def text(self, value):
        raw = value.encode() + b"\x00"
        self.put("I", len(raw))
        self.data += raw

    def header(self, t_ns, frame):
        self.put("i", t_ns // 10**9)
        self.put("I", t_ns % 10**9)
        self.text(frame)


def place(t):
    """x, roll, speed, and whether feet are on the ground."""
    if t < FALL_S:
        return SPEED_MPS * t, 0.0, SPEED_MPS, True
    if t < PLACED_S:
        roll = math.pi / 2 * min(1.0, (t - FALL_S) / (LIE_S - FALL_S))
        return SPEED_MPS * FALL_S, roll, 0.0, t < LIE_S
    return SPEED_MPS * FALL_S + 1.0 + SPEED_MPS * (t - PLACED_S), 0.0, SPEED_MPS, True


def contacts(k):
    """By the number of the sample: 20 a period, 12 of them stance."""
    first, second = k % 20 < 12, (k + 10) % 20 < 12
    return [first, second, second, first]


def quad_state(k, t_ns, t):
    x, roll, moves, stands = place(t)
    down = contacts(k) if stands else [False] * 4
    m = Cdr()
    m.header(t_ns, "world")
    m.put("d", x, 0.0, 0.3, math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2), *[0.0] * 36)
    m.put("d", moves, 0.0, 0.0, 0.0, 0.0, 0.0, *[0.0] * 36)
    m.put("d", *[0.0] * 6)
    m.header(t_ns, "")
    w = 2 * math.pi * 2.0
    m.put("d", *[POSE[j % 3] + 0.05 * math.sin(w * t) for j in range(12)])
    m.put("d", *[0.05 * w * math.cos(w * t)] * 12)
    m.put("d", *[5.0] * 12)
    m.put("d", *[0.0] * 12)
    m.put("?", *down)
    each = MASS_KG * G_MPS2 / max(1, sum(down))
    m.put("d", *[v for foot in down for v in (0.0, 0.0, each if foot else 0.0)])
    m.put("?", not stands)
    return m.data


def gait_state(k):
    m = Cdr()
    m.put("d", 0.4, *[0.6] * 4, 0.0, 0.5, 0.5, 0.0)
    m.put("?", *contacts(k))
    m.put("d", *[((k % 20) / 20 + offset) % 1.0 for offset in (0.0, 0.5, 0.5, 0.0)])
    m.put("B", 1)  # adaptive
    return m.data


def target():
    m = Cdr()
    m.put("d", SPEED_MPS, 0.0, 0.3, 0.0, 0.0, 0.0)
    return m.data


def battery():
    m = Cdr()
    m.put("f", 28.0, 4.0)
    return m.data


TOPICS = [
    ("/quad_state", "interfaces/msg/QuadState", 1, lambda k, t_ns, t: quad_state(k, t_ns, t)),
    ("/gait_state", "interfaces/msg/GaitState", 1, lambda k, t_ns, t: gait_state(k)),
    ("/quad_control_target", "interfaces/msg/QuadControlTarget", 10, lambda k, t_ns, t: target()),
    ("/battery_state", "interfaces/msg/BatteryState", 1, lambda k, t_ns, t: battery()),
]


def write_bag(folder):
    os.makedirs(folder)
    name = os.path.basename(folder)
    file = os.path.join(folder, name + "_0.db3")
    db = sqlite3.connect(file)
    db.executescript(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
        "serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,"
        "timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC);")
    counts = [0] * len(TOPICS)
    for number, (topic, kind, _, _) in enumerate(TOPICS):
        db.execute("INSERT INTO topics VALUES(?,?,?,'cdr','')", (number + 1, topic, kind))
    for k in range(int(LENGTH_S * RATE_HZ)):
        t_ns = START_NS + k * 10**9 // RATE_HZ
        for number, (_, _, every, make) in enumerate(TOPICS):
            if k % every:
                continue
            db.execute("INSERT INTO messages(topic_id,timestamp,data) VALUES(?,?,?)",
                       (number + 1, t_ns, bytes(make(k, t_ns, k / RATE_HZ))))
            counts[number] += 1
    db.commit()
    db.execute("VACUUM")
    db.close()
    topics = "".join(
        f"    - topic_metadata:\n        name: {topic}\n        type: {kind}\n        serialization_format: cdr\n"
        f"        offered_qos_profiles: \"\"\n      message_count: {count}\n"
        for (topic, kind, _, _), count in zip(TOPICS, counts))
    with open(os.path.join(folder, "metadata.yaml"), "w") as out:
        out.write(
            "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n  duration:\n"
            f"    nanoseconds: {int((LENGTH_S - 1 / RATE_HZ) * 10**9)}\n  starting_time:\n"
            f"    nanoseconds_since_epoch: {START_NS}\n  message_count: {sum(counts)}\n"
            f"  topics_with_message_count:\n{topics}  compression_format: \"\"\n  compression_mode: \"\"\n"
            f"  relative_file_paths:\n    - {name}_0.db3\n")


def main():
    folder = sys.argv[1]
    write_bag(os.path.join(folder, "rosbag2_2023_11_14-22_13_20"))
    os.makedirs(os.path.join(folder, "param-files"))
    with open(os.path.join(folder, "param-files", "mit_controller_node.yaml"), "w") as out:
        out.write("/mit_controller_node:\n  ros__parameters:\n    gait_sequencer: Adaptive\n"
                  "    model_urdf: src/common/model/urdf/go2/go2_description.urdf\n")
    with open(os.path.join(folder, "git-hash.txt"), "w") as out:
        out.write("80cdde1\n")


main()
