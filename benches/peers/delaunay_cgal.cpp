// Peer of benches/delaunay.rs in C++: the same points, triangulated and interpolated by CGAL.
//
// Build: c++ -std=c++17 -O3 -DNDEBUG delaunay_cgal.cpp -lgmp -lmpfr
// Usage: PROGRAM INPUTS   prints one JSON line per measurement
// Inputs as for delaunay.py. Along a drag, each point location starts at the face of the previous point. For random
// points, CGAL uses its triangulation hierarchy.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_hierarchy_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Valued = CGAL::Triangulation_vertex_base_with_info_2<double, Kernel>;
using Flat = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Valued>>;
using InLevels = CGAL::Triangulation_hierarchy_vertex_base_2<Valued>;
using Hierarchy = CGAL::Triangulation_hierarchy_2<
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<InLevels>>>;

static double seconds(clockid_t clock) {
    timespec time;
    clock_gettime(clock, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

// As in measure.py; `work` returns the note.
template <class Work>
static void bench(const std::string& name, const char* peer, size_t units, const char* unit, Work work) {
    const std::string note = work();
    const double warm = seconds(CLOCK_MONOTONIC);
    work();
    const int inner = std::max(1, int(0.3 / (seconds(CLOCK_MONOTONIC) - warm)));
    const char* asked = std::getenv("BENCH_REPS");
    const int reps = asked ? std::atoi(asked) : 5;
    for (int rep = 0; rep < reps; rep++) {
        const double cpu_start = seconds(CLOCK_PROCESS_CPUTIME_ID), wall_start = seconds(CLOCK_MONOTONIC);
        for (int i = 0; i < inner; i++) work();
        const double cpu = (seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_start) / inner;
        const double wall = (seconds(CLOCK_MONOTONIC) - wall_start) / inner;
        std::printf("{\"case\": \"%s\", \"peer\": \"%s\", \"cpu_s\": %.9g, \"wall_s\": %.9g, \"units\": %zu, "
                    "\"unit\": \"%s\", \"per_s\": %.9g, \"threads\": 1, \"note\": \"%s\"}\n",
                    name.c_str(), peer, cpu, wall, units, unit, double(units) / cpu, note.c_str());
        std::fflush(stdout);
    }
}

static std::vector<Point> points_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        std::fprintf(stderr, "cannot read %s; create the inputs with delaunay.py --make\n", path.c_str());
        std::exit(1);
    }
    std::vector<Point> points;
    double xy[2];
    while (file.read(reinterpret_cast<char*>(xy), sizeof xy)) points.emplace_back(xy[0], xy[1]);
    return points;
}

// Returns the value at a point of a face, by barycentric interpolation.
template <class Face>
static double value_in(const Face& face, const Point& at) {
    const Point &a = face->vertex(0)->point(), &b = face->vertex(1)->point(), &c = face->vertex(2)->point();
    const double ax = a.x() - c.x(), ay = a.y() - c.y(), bx = b.x() - c.x(), by = b.y() - c.y();
    const double x = at.x() - c.x(), y = at.y() - c.y(), whole = ax * by - ay * bx;
    const double u = (x * by - y * bx) / whole, v = (ax * y - ay * x) / whole;
    return u * face->vertex(0)->info() + v * face->vertex(1)->info() + (1 - u - v) * face->vertex(2)->info();
}

template <class Triangulation>
static std::string values(const Triangulation& triangulation, const std::vector<Point>& points, bool is_drag) {
    typename Triangulation::Face_handle face;
    size_t n_inside = 0;
    double sum = 0;
    for (const Point& at : points) {
        face = is_drag ? triangulation.locate(at, face) : triangulation.locate(at);
        if (triangulation.is_infinite(face)) continue;
        n_inside++;
        sum += value_in(face, at);
    }
    char said[99];
    std::snprintf(said, sizeof said, "%.3f %% inside, mean %.9f", 100.0 * double(n_inside) / double(points.size()),
                  sum / double(n_inside));
    return said;
}

int main(int n_arguments, char** arguments) {
    if (n_arguments != 2) return 2;
    const std::string folder = std::string(arguments[1]) + "/delaunay_";
    const std::vector<Point> drag = points_of(folder + "drag.f64"), anywhere = points_of(folder + "random.f64");
    for (const char* name : {"25", "1000", "10000", "100000"}) {
        std::vector<std::pair<Point, double>> sites;
        for (const Point& at : points_of(folder + name + ".f64"))
            sites.emplace_back(at, std::sin(6 * at.x()) + std::cos(5 * at.y()));
        const std::string among = std::string("interpolation among ") + name + " points ";
        Flat flat;
        bench(std::string("Delaunay of ") + name + " points", "CGAL", sites.size(), "point", [&] {
            flat.clear();
            flat.insert(sites.begin(), sites.end());
            return std::to_string(flat.number_of_faces()) + " triangles";
        });
        bench(among + "along a drag", "CGAL, last face", drag.size(), "value",
              [&] { return values(flat, drag, true); });
        Hierarchy hierarchy;
        for (const auto& [at, value] : sites) hierarchy.insert(at)->info() = value;
        bench(among + "at random", "CGAL, hierarchy", anywhere.size(), "value",
              [&] { return values(hierarchy, anywhere, false); });
    }
}
