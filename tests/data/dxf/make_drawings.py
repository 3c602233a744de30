#!/usr/bin/env python3
"""Makes the drawings of the DXF tests: make_drawings.py FILE R12|R2010 (needs python3-ezdxf)."""
import sys

import ezdxf

# What the DXF test reads; see cairn/io/dxf_test.cpp for what it expects.
doc = ezdxf.new(sys.argv[2]); doc.header["$INSUNITS"] = 4  # millimetres
for layer in ("walls", "GLASS-facade"):
    doc.layers.add(layer)
msp = doc.modelspace()
msp.add_line((0, 0), (4000, 0), dxfattribs={"layer": "walls"})
msp.add_line((4000, 0), (4000, 3000), dxfattribs={"layer": "GLASS-facade"})
if sys.argv[2] == "R12":
    msp.add_polyline2d([(0, 0), (0, 3000), (4000, 3000)], dxfattribs={"layer": "walls"})
    msp.add_polyline2d([(1000, 1000, 0, 0, 1), (2000, 1000, 0, 0, 0)], format="xyseb", dxfattribs={"layer": "walls"})
else:
    msp.add_lwpolyline([(0, 0), (0, 3000), (4000, 3000)], dxfattribs={"layer": "walls"})
    msp.add_lwpolyline([(1000, 1000, 1), (2000, 1000, 0)], format="xyb", dxfattribs={"layer": "walls"})
msp.add_circle((3000, 2000), 250, dxfattribs={"layer": "walls"})
msp.add_arc((10000, 0), 1000, 350, 80, dxfattribs={"layer": "walls"})
leaf = doc.blocks.new("LEAF", base_point=(100, 0))
leaf.add_line((100, 0), (1100, 0))
door = doc.blocks.new("DOOR")
door.add_blockref("LEAF", (0, 500), dxfattribs={"rotation": 90})
door.add_line((0, 0), (0, 500), dxfattribs={"layer": "walls"})
msp.add_blockref("DOOR", (20000, 0), dxfattribs={"layer": "GLASS-facade", "xscale": 2, "yscale": -1, "rotation": 30})
msp.add_blockref("LEAF", (30000, 0), dxfattribs={"layer": "walls", "column_count": 3, "row_count": 2, "column_spacing": 2000, "row_spacing": 5000, "rotation": 90})
msp.add_text("not a wall")
doc.layout().add_line((0, 0), (1, 1))
doc.saveas(sys.argv[1])
