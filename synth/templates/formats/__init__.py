"""Templates as files: pages as SVG and PDF, pieces side by side as DXF."""
