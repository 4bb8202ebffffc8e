#!/usr/bin/env python3
"""Writes the field log of docs/tutorials/field_log.md: a walk of another robot, in columns of its own.

    scoria run scenarios/rough.yaml --set "robot={base: tests/data/robots/mule/mule.yaml}" --set terrain.roughness_scale=2 \\
        --set operator.speed_mps=0.6 --set operator.distance_m=8 --set seed=7 --out out/mule
    scoria export out/mule/log.mcap -o out/mule.csv --signals
    python3 samples/make_mule_log.py out/mule.csv samples/mule_field

Two tables at 100 Hz: drives.csv (angles and rates in degrees, legs LH LF RH RF) and nav.csv (odometry, attitude in degrees,
accelerometer in g, gyroscope, battery). The truth is left out, and so are contacts and forces of the feet.
"""
import csv
import math
import os
import sys

EVERY = 5  # of 500 rows a second
LEGS = [("LH", 2), ("LF", 0), ("RH", 3), ("RF", 1)]  # and their number among FL FR HL HR
JOINTS = ["abd", "hip", "knee"]
DEG = 180.0 / math.pi


def main():
    rows = list(csv.DictReader(open(sys.argv[1])))[::EVERY]
    os.makedirs(sys.argv[2], exist_ok=True)

    def number(row, key):
        return float(row[key]) if row[key] else float("nan")

    def each(kind):
        return [f"{leg}_{joint}_{kind}" for leg, _ in LEGS for joint in JOINTS]

    def twelve(row, key, scale, digits):
        return [f"{scale * number(row, f'{key}[{3 * i + j}]'):.{digits}f}" for _, i in LEGS for j in range(3)]

    with open(os.path.join(sys.argv[2], "drives.csv"), "w") as out:
        out.write(",".join(["stamp_ms"] + each("deg") + each("dps") + each("Nm")) + "\n")
        for row in rows:
            line = [f"{1e3 * float(row['time_s']):.0f}"]
            line += twelve(row, "measured.q_rad", DEG, 3) + twelve(row, "measured.qd_radps", DEG, 2)
            out.write(",".join(line + twelve(row, "measured.tau_Nm", 1.0, 2)) + "\n")
    with open(os.path.join(sys.argv[2], "nav.csv"), "w") as out:
        out.write("stamp_ms,pos_x,pos_y,pos_z,vel_x,vel_y,vel_z,roll,pitch,yaw,acc_x,acc_y,acc_z,"
                  "gyro_x,gyro_y,gyro_z,volt,amp,cmd_vx,cmd_vy,cmd_wz\n")
        for row in rows:
            line = [f"{1e3 * float(row['time_s']):.0f}"]
            line += [f"{number(row, f'estimate.p_WB_m[{k}]'):.4f}" for k in range(3)]
            line += [f"{number(row, f'estimate.v_WB_mps[{k}]'):.4f}" for k in range(3)]
            line += [f"{DEG * number(row, f'estimate.rpy_rad[{k}]'):.3f}" for k in range(3)]
            line += [f"{number(row, f'measured.a_WS_S_mps2[{k}]') / 9.80665:.4f}" for k in range(3)]
            line += [f"{number(row, f'measured.w_WS_S_radps[{k}]'):.4f}" for k in range(3)]
            line += [f"{number(row, 'measured.battery_V'):.3f}", f"{number(row, 'measured.battery_A'):.3f}"]
            line += [f"{number(row, f'command.{k}'):.3f}" for k in ("v_x_mps", "v_y_mps", "w_z_radps")]
            out.write(",".join(line) + "\n")


main()
