#!/usr/bin/env python3
"""Makes the gallery's real outlines (.poly) from Natural Earth.

    npm pack world-atlas@2.0.2 && tar xf world-atlas-2.0.2.tgz
    python3 make.py package/countries-10m.json            (needs numpy and shapely 2.1 or later)

Source: Natural Earth 1:10m, version 4.1.0, public domain, as TopoJSON in the npm package world-atlas 2.0.2 (licence
ISC, copyright Michael Bostock). The package quantises coordinates to 0.0036 by 0.0017 degrees.

What is done to it, in this order, for each outline:
 1. longitude and latitude become kilometres east and north of the window's centre: x = R cos(lat0) (lon - lon0),
    y = R (lat - lat0), R = 6371.0088 km;
 2. invalid rings are mended (shapely.make_valid) and cut to the window;
 3. lakes, islands and parts of sea below AREA km2 are dropped;
 4. countries are simplified together, so that common borders stay common (coverage_simplify at TOLERANCE km);
 5. vertices are removed until no vertex is within APART km of another vertex or of a segment that does not end there,
    so that no feature is smaller than about a thousandth of the outline (norway: a four thousandth);
 6. coordinates are rounded to ten metres and the result is checked to be valid.
Segment markers: 1 coast, 2 border between two parts, 3 edge of the window. Region attributes number the parts.
"""
import json, math, sys
import numpy as np
import shapely
from shapely.geometry import Polygon, box
from shapely.ops import unary_union

RADIUS = 6371.0088  # km, the mean radius of the Earth
OUTLINES = {
    # name: window (west, south, east, north), parts, whether the sea is meant, AREA, TOLERANCE, APART
    'aegean': ((22.5, 34.7, 28.2, 41.2), ['Greece', 'Turkey', 'Bulgaria', 'Macedonia', 'Albania'], True, 5.0, 0.6, 0.6),
    'british-isles': ((-11.0, 49.8, 2.0, 59.5), ['United Kingdom', 'Ireland', 'Isle of Man'], False, 10.0, 1.2, 1.0),
    'iceland': ((-25.0, 63.0, -13.0, 67.0), ['Iceland'], False, 1.0, 0.15, 0.4),
    'italy': ((6.0, 35.0, 19.0, 48.0), ['Italy'], False, 6.0, 0.3, 0.6),
    'norway': ((4.0, 57.5, 32.0, 71.5), ['Norway'], False, 1.0, 0.4, 0.4),
}


def read_countries(path):
    """Country name -> shapely geometry in degrees."""
    with open(path) as file:
        topology = json.load(file)
    scale, shift = (np.array(topology['transform'][key]) for key in ('scale', 'translate'))
    arcs = [np.cumsum(np.array(arc), 0) * scale + shift for arc in topology['arcs']]

    def ring(numbers):
        parts = [arcs[k] if k >= 0 else arcs[~k][::-1] for k in numbers]
        return np.concatenate([parts[0]] + [part[1:] for part in parts[1:]])

    countries = {}
    for entry in topology['objects']['countries']['geometries']:
        if entry['type'] not in ('Polygon', 'MultiPolygon'):
            continue
        polygons = entry['arcs'] if entry['type'] == 'MultiPolygon' else [entry['arcs']]
        rings = [[ring(numbers) for numbers in polygon] for polygon in polygons]
        parts = [Polygon(r[0], r[1:]) for r in rings if len(r[0]) > 3]
        countries[entry['properties']['name']] = shapely.make_valid(shapely.MultiPolygon(parts))
    return countries


def polygons(geometry):
    """The polygons of any geometry."""
    if geometry.geom_type == 'Polygon':
        return [geometry]
    return [part for piece in getattr(geometry, 'geoms', []) for part in polygons(piece)]


def without_small(geometry, area):
    """Drops polygons and holes below an area."""
    kept = []
    for polygon in polygons(geometry):
        holes = [hole for hole in polygon.interiors if Polygon(hole).area >= area]
        polygon = Polygon(polygon.exterior, holes)
        if polygon.area >= area:
            kept.append(polygon)
    return kept


def rings(parts):
    return [np.array(ring.coords)[:-1] for part in parts for ring in [part.exterior, *part.interiors]]


def close_vertices(parts, apart):
    """Vertices closer than `apart` to another vertex, or to a segment that does not end there; the closest first."""
    segments = {}
    for ring in rings(parts):
        for a, b in zip(map(tuple, ring), map(tuple, np.roll(ring, -1, 0))):
            segments[min(a, b), max(a, b)] = None
    segments = list(segments)
    lines = shapely.linestrings(np.array(segments))
    tree = shapely.STRtree(lines)
    vertices = sorted({end for segment in segments for end in segment})
    found, near = tree.query(shapely.points(vertices), predicate='dwithin', distance=apart)
    close = {}
    for v, s in zip(found, near):
        vertex = vertices[v]
        if vertex in segments[s]:
            other = segments[s][segments[s][0] == vertex]
            distance = math.dist(vertex, other)
            if distance >= apart:
                continue
        else:
            distance = shapely.distance(shapely.Point(vertex), lines[s])
        close[vertex] = min(distance, close.get(vertex, math.inf))
    return sorted(close, key=lambda vertex: (close[vertex], vertex))


def spread(parts, apart, area, fixed):
    """Removes close vertices, never two in a row at once, until there are none."""
    while close := [vertex for vertex in close_vertices(parts, apart) if vertex not in fixed]:
        gone, blocked = set(), set()
        neighbours = {}
        for ring in rings(parts):
            around = list(map(tuple, ring))
            for k, vertex in enumerate(around):
                neighbours.setdefault(vertex, []).extend([around[k - 1], around[(k + 1) % len(around)]])
        for vertex in close:
            if vertex not in blocked:
                gone.add(vertex)
                blocked.update(neighbours[vertex])
        kept = []
        for part in parts:
            shells = []
            for ring in [part.exterior, *part.interiors]:
                points = [p for p in ring.coords[:-1] if p not in gone]
                shells.append(points if len(points) >= 3 else None)
            if shells[0]:
                polygon = Polygon(shells[0], [hole for hole in shells[1:] if hole])
                kept += without_small(shapely.make_valid(polygon), area)
        parts = kept
    return parts


def make(name, countries):
    window, names, is_sea, area, tolerance, apart = OUTLINES[name]
    west, south, east, north = window
    lon0, lat0 = (west + east) / 2, (south + north) / 2
    unit = RADIUS * math.pi / 180

    def project(lonlat):
        return np.column_stack([(lonlat[:, 0] - lon0) * unit * math.cos(math.radians(lat0)), (lonlat[:, 1] - lat0) * unit])

    frame = shapely.transform(box(*window), project)
    land = [shapely.make_valid(shapely.transform(countries[country], project)) for country in names]
    if is_sea:
        sea = polygons(frame.difference(unary_union(land)))
        pieces = [max(sea, key=lambda piece: piece.area)]
    else:
        pieces = [shapely.intersection(country, frame) for country in land]
    labelled = [(number, part) for number, piece in enumerate(pieces, 1) for part in without_small(piece, area)]
    simple = list(shapely.coverage_simplify([part for _, part in labelled], tolerance, simplify_boundary=True))
    simple = [part for piece in simple for part in without_small(shapely.make_valid(piece), area)]
    simple = spread(simple, apart, area, set(frame.exterior.coords))
    simple = [shapely.transform(part, lambda points: np.round(points, 2)) for part in simple]
    parts = []
    for part in simple:
        inside = part.representative_point()
        number = min((shapely.distance(original, inside), number) for number, original in labelled)[1]
        parts.append((number, part))
    assert all(part.is_valid for _, part in parts), f'{name}: invalid part'
    write(name, parts, frame)


def write(name, parts, frame):
    vertices, segments = {}, {}
    for _, part in parts:
        for ring in rings([part]):
            ids = [vertices.setdefault(tuple(point), len(vertices)) for point in ring.tolist()]
            for a, b in zip(ids, ids[1:] + ids[:1]):
                segments.setdefault((min(a, b), max(a, b)), []).append((a, b))
    points = list(vertices)
    edge = frame.exterior

    def marker(uses):
        if len(uses) > 1:
            return 2
        middle = shapely.Point(*(np.array(points[uses[0][0]]) + points[uses[0][1]]) / 2)
        return 3 if edge.distance(middle) < 0.02 else 1

    whole = unary_union([part for _, part in parts])
    holes = [Polygon(ring).difference(whole) for part in polygons(whole) for ring in part.interiors]
    hole_points = [piece.representative_point() for hole in holes for piece in polygons(hole)]
    numbers = {number for number, _ in parts}
    regions = [(part.representative_point(), number) for number, part in parts] if len(numbers) > 1 else []
    with open(f'{name}.poly', 'w') as out:
        print('# made by make.py: Natural Earth 1:10m (public domain) from world-atlas 2.0.2 (ISC); kilometres', file=out)
        print(len(points), 2, 0, 0, file=out)
        for k, (x, y) in enumerate(points):
            print(f'{k} {x:.2f} {y:.2f}', file=out)
        print(len(segments), 1, file=out)
        for k, uses in enumerate(segments.values()):
            print(k, *uses[0], marker(uses), file=out)
        print(len(hole_points), file=out)
        for k, point in enumerate(hole_points):
            print(f'{k} {point.x:.3f} {point.y:.3f}', file=out)
        if regions:
            print(len(regions), file=out)
            for k, (point, number) in enumerate(regions):
                print(f'{k} {point.x:.3f} {point.y:.3f} {number} -1', file=out)
    print(f'{name}: {len(points)} vertices, {len(segments)} segments, {len(parts)} parts, {len(hole_points)} holes')


def main():
    countries = read_countries(sys.argv[1])
    for name in sys.argv[2:] or OUTLINES:
        make(name, countries)


if __name__ == '__main__':
    main()
