"""Growing trees after Weber and Penn, "Creation and rendering of realistic trees" (1995).

All stems of one branching order are grown together, segment by segment::

    Shoots  where stems will stand      sprout.py    counts, offsets, down angles, lengths
      | grow_axes
    Axes    centre lines, in segments   axes.py      curving, attraction up, helices, splitting
      | divided                         divide.py    one segment is one link, or several on a smooth curve
      | fit_lengths                     pruning.py   shortened until they fit the envelope
      | make_wood
    Wood    links with radii            wood.py      taper, flare, parents
      | sprout -> Shoots of the next order, or grow_leaves on the last (leaves.py)

`grow` in grow.py walks down these steps and puts the result in depth-first order.
"""

from windswept.plants.weber_penn.grow import grow

__all__ = ["grow"]
