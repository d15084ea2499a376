"""Air velocity in m/s at (x, y, z, t): every source yields velocity and they add up.

    Profile  x  ( MeanWind + WaveSchedule + Gusts )  = Wind  --velocity(points, height, time)-->  (N, 3) m/s

Sources give a horizontal velocity at the profile's reference height; the profile scales their sum to the
height above ground. Azimuths say where the air goes *to*, counter-clockwise from +x (east).
"""
