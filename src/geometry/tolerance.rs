//! Every tolerance of the library, each relative to a length named in its comment, each with its reason.

/// Certificate: biting circles are enlarged, and packing circles shrunk, by this share of their radius. Centres are
/// intersections of circles, computed to a few ulp of the coordinates; 1e-9 is enough for that down to circles of a
/// millionth of the domain, and far below anything that shows in a mesh.
pub const CERTIFICATE: f64 = 1e-9;

/// Certificate: the distance of two centres may fall short of the sum of their packing radii, or be beyond the bounds of nn,
/// by this number of ulp of their coordinates (an ulp being [`f64::EPSILON`] of the larger). This is what rounding can take,
/// proved: a centre that is an intersection of circles is one sum of two vectors, each axis rounded by half an ulp, which
/// moves it by √½; one on a segment is start + (end − start) / length · position, at most 5 in all since no side exceeds
/// twice the largest coordinate. Two values of f, which Lemma 5.4 compares, are each off by 1.5 ulp of a distance of at most
/// 2√2 of that coordinate, and count by c_p ≤ 1/2: another 4.3. This exceeds [`CERTIFICATE`] only for circles under a
/// millionth of the coordinates.
pub const CENTRE_ULPS: f64 = 10.0;

/// Biting: a point counts as inside an open circle only if it is inside the one shrunk by this share of its radius.
/// On uniform spacing every front vertex lies on up to six circles at once; erring towards "not covered" keeps such
/// vertices, and a hundredth of [`CERTIFICATE`] can never make the certificate fail.
pub const COVERED: f64 = 1e-11;

/// Biting by the rule of the later point: the place where a line leaves what is eaten is found to this share of the radius there, a
/// hundredth of [`COVERED`].
pub const EATEN: f64 = 1e-13;

/// Spacing: the smallest target edge length a mesher takes, relative to the largest coordinate. Below it, points one
/// edge apart differ in their last ten bits only, and intersections of circles mean nothing.
pub const RESOLUTION: f64 = 1.0 / (1u64 << 42) as f64;

/// Domain: a grid cell counts as met by every segment that comes within this share of a cell. Cell coordinates are
/// computed to about 1e-12 of a cell, so no segment is missed; exact predicates decide within the cells met.
pub const GRID_SLACK: f64 = 1e-6;

/// Domain: an angle of at most this many radians between two segments counts as 0, as in the independent check.
pub const NO_ANGLE: f64 = 1e-12;

/// Domain: an input angle is acute when it is less than 60° by more than this many radians, so that the corners of
/// equilateral triangles, computed to about 1e-16, are not.
pub const ACUTE_MARGIN: f64 = 1e-9;

/// Short lists of the spacing: a feature is kept while it comes within this share of what decides. Distances are
/// computed to a few ulp; a feature too many costs nothing but time.
pub const SHORTLIST: f64 = 1e-12;

/// Short lists of the spacing: a point counts as in a cell if it is beside it by at most this many ulp of the largest coordinate. A
/// cell's side is halved from the root up to 40 times, each time rounded by half an ulp; a point's place in the root by two ulp.
pub const CELL_ULPS: f64 = 64.0;

/// Matching a mesh to a domain: coordinates that differ by at most this many ulp of the largest coordinate are the same
/// vertex. Files keep doubles whole; other programs may shift a domain and back. Boundary edges may lie beside their
/// segments by as much, so the area may differ by that times the length of the boundary.
pub const SAME_VERTEX_ULPS: f64 = 4.0;

/// Matching a mesh to a domain: a mesh edge lies along an input segment if it leaves it by at most this share of its
/// length (and by [`SAME_VERTEX_ULPS`]): points on a segment are rounded to an ulp, which short edges see as an angle.
pub const ALONG_SEGMENT: f64 = 1e-9;

/// Certificate: areas of triangles must sum to the domain's within this relative difference; the sum of a million
/// rounded areas is accurate to about 1e-12.
pub const AREA: f64 = 1e-9;

/// Certificate: an angle between segments of less than 90° by at most this many degrees counts as 90°, so that a rotated
/// square keeps the paper's hypothesis.
pub const RIGHT_ANGLE_DEG: f64 = 1e-6;

/// Domain: step of the grid on which repair places crossings, relative to the larger side of the PSLG: a hundredth of
/// a millimetre on forty kilometres. Coarse enough that ends meant to touch do not leave slivers of a few ulp.
pub const REPAIR_GRID: f64 = 1.0 / (1u64 << 32) as f64;

/// Gradient limiting: a lower bound of f is taken this share of the largest coordinate lower. Distances and their
/// differences are computed to a few ulp of the coordinates.
pub const LOWER_BOUND: f64 = 16.0 * f64::EPSILON;
