"""Models of robots read as mechanisms: MJCF (MuJoCo), URDF (ROS) with its loops beside it, and SDF (Gazebo).

Bodies become links, fixed joints and welds make one link of several, joints get their axes where the file has them at
its own configuration. Hinges alone make hinged solids, other joints a placed linkage of joints of all kinds. Shapes,
masses, limits, springs and motors are ignored; what might change how a robot moves and is not understood is told in
the notes of the mechanism, or refused.
"""
