"""Drive a model of synthedra in MuJoCo: its first actuator over its range in 10 seconds, and say how far loops open.

python drive.py miura.xml

A twentieth of the range is left out at each end, where sheets are flat and linkages turn back.
"""

import sys

import mujoco
import numpy as np

SECONDS, LEFT_OUT = 10.0, 0.05

model = mujoco.MjModel.from_xml_path(sys.argv[1])
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
joint = model.actuator_trnid[0, 0]
here = data.qpos[model.jnt_qposadr[joint]]
low, high = model.actuator_ctrlrange[0]
margin = LEFT_OUT * (high - low)
goals = [low + margin, high - margin]
steps, opened = int(SECONDS / model.opt.timestep / len(goals)), 0.0
for goal in goals:
    for part in np.linspace(0.0, np.pi, steps):
        data.ctrl[0] = here + (goal - here) * (1.0 - np.cos(part)) / 2.0
        mujoco.mj_step(model, data)
        opened = max(opened, float(np.abs(data.efc_pos[: data.ne]).max(initial=0.0)))
    here = goal
    print(f"{model.joint(joint).name} at {np.degrees(data.qpos[model.jnt_qposadr[joint]]):.3f} degrees")
print(f"loops opened by at most {opened:.1e} m in {data.time:.1f} s")
