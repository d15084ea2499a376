"""windswept grows plants, blows wind through them, and shows or exports the motion.

The line through the house; data goes down it and never back::

    species | grammar | scan  --grow-->   Plant      rest skeleton: stems, links, leaves
    Scene (ground, placed plants, wind, camera)  --compile-->  Model + State
    State                     --step-->   State      one fixed inner step of the motion
    State                     --pose-->   Pose       where every link is now
    (Geometry, Pose)          --draw-->   picture or video

The rooms, in the order in which they may import each other::

    plants, wind  <  motion, geometry  <  scene  <  gpu  <  render  <  cli
"""
