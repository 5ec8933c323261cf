// CGAL Mesh_2 behind the protocol of ../PROTOCOL.md: Delaunay refinement whose criterion reads the size field.

#include "../field.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/lloyd_optimize_mesh_2.h>
#include <CGAL/version.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <tuple>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using Faces = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertices, Faces>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Point = Triangulation::Point;
using boost::property_tree::ptree;

constexpr int DECLINED = 4;

// The peer cannot take this input; the message says why.
struct Declined : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// ---- request and domain

struct Domain {
    std::vector<Point> points;
    std::vector<std::pair<std::size_t, std::size_t>> segments;
    std::vector<Point> holes;
};

// A .poly file counted from 0.
Domain read_domain(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + ": cannot be read");
    const auto next_row = [&] {
        std::string line, word;
        std::vector<std::string> words;
        while (words.empty() && std::getline(file, line)) {
            std::istringstream row(line.substr(0, line.find('#')));
            while (row >> word) words.push_back(word);
        }
        return words;
    };
    const auto rows = [&] {
        std::vector<std::vector<std::string>> found(std::stoul(next_row().at(0)));
        for (auto& row : found) row = next_row();
        return found;
    };
    Domain domain;
    for (const auto& row : rows()) domain.points.emplace_back(std::stod(row.at(1)), std::stod(row.at(2)));
    for (const auto& row : rows()) domain.segments.emplace_back(std::stoul(row.at(1)), std::stoul(row.at(2)));
    for (const auto& row : rows()) domain.holes.emplace_back(std::stod(row.at(1)), std::stod(row.at(2)));
    return domain;
}

std::optional<Field> read_size(const ptree& request) {
    const ptree& size = request.get_child("size");
    if (const auto uniform = size.get_optional<double>("uniform")) return Field::uniform(*uniform);
    if (const auto file = size.get_optional<std::string>("field"))
        return Field::read(*file, size.get<double>("scale"));
    return std::nullopt;
}

struct Parameters {
    double aspect; // B: the squared sine of the smallest angle to reach; 0.125, for 20.7 degrees, is the largest that surely ends
    int lloyd;     // steps of Lloyd's iteration after the refinement
};

Parameters read_parameters(const ptree& request) {
    return {request.get<double>("parameters.aspect"), request.get<int>("parameters.lloyd")};
}

// ---- what CGAL asks of a criterion

// A triangle is bad where its smallest angle is under the bound, and must go where its longest edge is above s at that edge's
// middle. Without a field the angle alone decides.
class Criterion {
  public:
    using Face_handle = Triangulation::Face_handle;

    struct Quality {
        double oversize = 1.0; // (longest edge / s)², at least 1: among what fits, the angle orders
        double sine = 1.0;     // of the smallest angle, squared

        bool operator<(const Quality& other) const {
            return std::tie(other.oversize, sine) < std::tie(oversize, other.sine);
        }
    };

    class Is_bad {
      public:
        Is_bad(const Field* field, double aspect) : field_(field), aspect_(aspect) {}

        CGAL::Mesh_2::Face_badness operator()(const Quality& quality) const {
            if (quality.oversize > 1.0) return CGAL::Mesh_2::IMPERATIVELY_BAD;
            return quality.sine < aspect_ ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
        }

        CGAL::Mesh_2::Face_badness operator()(const Face_handle& face, Quality& quality) const {
            std::array<Point, 3> p;
            for (int k = 0; k < 3; ++k) p[k] = face->vertex(k)->point();
            std::array<double, 3> squared; // of the edge opposite to each corner
            for (int k = 0; k < 3; ++k) squared[k] = CGAL::squared_distance(p[(k + 1) % 3], p[(k + 2) % 3]);
            const std::size_t longest = std::max_element(squared.begin(), squared.end()) - squared.begin();
            const double shortest = *std::min_element(squared.begin(), squared.end());
            const double twice_area = 2.0 * CGAL::area(p[0], p[1], p[2]);
            quality.sine = twice_area * twice_area * shortest / (squared[0] * squared[1] * squared[2]);
            quality.oversize = 1.0;
            if (field_ != nullptr) {
                const Point middle = CGAL::midpoint(p[(longest + 1) % 3], p[(longest + 2) % 3]);
                const double size = field_->at(middle.x(), middle.y());
                quality.oversize = std::max(1.0, squared[longest] / (size * size));
            }
            return (*this)(quality);
        }

      private:
        const Field* field_;
        double aspect_;
    };

    Criterion(const Field* field, double aspect) : field_(field), aspect_(aspect) {}
    Is_bad is_bad_object() const { return Is_bad(field_, aspect_); }

  private:
    const Field* field_;
    double aspect_;
};

// ---- the work

struct Mesh {
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 3>> triangles;
};

Mesh mesh(const Domain& domain, const Field* field, const Parameters& parameters, std::size_t& unrefined_vertices) {
    Triangulation triangulation;
    try {
        triangulation.insert(domain.points.begin(), domain.points.end());
        triangulation.insert_constraints(domain.points.begin(), domain.points.end(), domain.segments.begin(),
                                         domain.segments.end());
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
        throw Declined("two segments cross, and the crossing is no vertex of the domain");
    }
    unrefined_vertices = triangulation.number_of_vertices();

    CGAL::Delaunay_mesher_2<Triangulation, Criterion> mesher(triangulation, Criterion(field, parameters.aspect));
    mesher.set_seeds(domain.holes.begin(), domain.holes.end(), false);
    mesher.refine_mesh();
    if (parameters.lloyd > 0)
        CGAL::lloyd_optimize_mesh_2(triangulation, CGAL::parameters::max_iteration_number = parameters.lloyd,
                                    CGAL::parameters::seeds_begin = domain.holes.begin(),
                                    CGAL::parameters::seeds_end = domain.holes.end(), CGAL::parameters::mark = false);

    Mesh result;
    CGAL::Unique_hash_map<Triangulation::Vertex_handle, std::size_t> number(SIZE_MAX);
    for (const auto face : triangulation.finite_face_handles()) {
        if (!face->is_in_domain()) continue;
        auto& triangle = result.triangles.emplace_back();
        for (int k = 0; k < 3; ++k) {
            std::size_t& index = number[face->vertex(k)];
            if (index == SIZE_MAX) {
                index = result.points.size();
                result.points.push_back(face->vertex(k)->point());
            }
            triangle[k] = index;
        }
    }
    return result;
}

// ---- answer

void write_mesh(const std::string& stem, const Mesh& mesh) {
    const auto open = [](const std::string& path) {
        std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
        if (!file) throw std::runtime_error(path + ": cannot be written");
        return file;
    };
    const auto nodes = open(stem + ".node");
    std::fprintf(nodes.get(), "%zu 2 0 0\n", mesh.points.size());
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
        std::fprintf(nodes.get(), "%zu %.17g %.17g\n", k, mesh.points[k].x(), mesh.points[k].y());
    const auto elements = open(stem + ".ele");
    std::fprintf(elements.get(), "%zu 3 0\n", mesh.triangles.size());
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
        std::fprintf(elements.get(), "%zu %zu %zu %zu\n", k, mesh.triangles[k][0], mesh.triangles[k][1],
                     mesh.triangles[k][2]);
}

// A field of /proc/self/status: `VmRSS:` is the resident memory now, `VmHWM:` its peak.
long memory_bytes(const std::string& field) {
    std::ifstream file("/proc/self/status");
    std::string word;
    while (file >> word && word != field) {
    }
    long kilobytes = 0;
    file >> kilobytes;
    return 1024L * kilobytes;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void answer(const std::string& request_path) {
    auto start = std::chrono::steady_clock::now();
    ptree request;
    boost::property_tree::read_json(request_path, request);
    const Parameters parameters = read_parameters(request);
    const Domain domain = read_domain(request.get<std::string>("domain"));
    const double read = seconds_since(start);

    start = std::chrono::steady_clock::now();
    const std::optional<Field> field = read_size(request);
    const double size_field = seconds_since(start);

    const long before = memory_bytes("VmRSS:");
    start = std::chrono::steady_clock::now();
    std::size_t unrefined_vertices = 0;
    const Mesh result = mesh(domain, field ? &*field : nullptr, parameters, unrefined_vertices);
    const double meshing = seconds_since(start);
    const long peak = memory_bytes("VmHWM:");

    write_mesh(request.get<std::string>("mesh"), result);
    std::ofstream file(request.get<std::string>("answer"));
    file.precision(9);
    file << "{\"version\": \"" << CGAL_VERSION_STR << "\", \"seconds\": {\"imports\": 0, \"read\": " << read
         << ", \"size_field\": " << size_field << ", \"mesh\": " << meshing << "}, \"rss_before_bytes\": " << before
         << ", \"peak_rss_bytes\": " << peak << ", \"counts\": {\"unrefined_vertices\": " << unrefined_vertices
         << "}}\n";
}

// For the test that holds field.hpp to protocol.py: s at the points given as pairs of numbers on standard input.
void evaluate(const std::string& path, double scale) {
    const Field field = Field::read(path, scale);
    double x = 0.0, y = 0.0;
    while (std::cin >> x >> y) std::printf("%.17g\n", field.at(x, y));
}

int main(int count, char** arguments) {
    try {
        if (count == 4 && std::string(arguments[1]) == "--evaluate") {
            evaluate(arguments[2], std::stod(arguments[3]));
        } else if (count == 2) {
            answer(arguments[1]);
        } else {
            std::cerr << "usage: cgal REQUEST.json | cgal --evaluate FIELD SCALE\n";
            return 2;
        }
    } catch (const Declined& reason) {
        std::cerr << reason.what() << '\n';
        return DECLINED;
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
