// The size field of PROTOCOL.md for adapters in C++: the same arithmetic as protocol.py, so the same doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

// The edge length s asked for: the background quadtree with nodal values, or one value everywhere.
class Field {
  public:
    static Field uniform(double size) {
        Field field;
        field.side_ = 1.0;
        field.first_child_ = {-1};
        field.corners_ = {{size, size, size, size}};
        return field;
    }

    static Field read(const std::string& path, double scale) {
        std::ifstream file(path, std::ios::binary);
        char magic[8] = {};
        file.read(magic, sizeof magic);
        if (!file || std::memcmp(magic, "BITFIELD", sizeof magic) != 0)
            throw std::runtime_error(path + ": not a size field");
        Field field;
        std::uint64_t count = 0;
        read_into(file, &field.x0_, 1);
        read_into(file, &field.y0_, 1);
        read_into(file, &field.side_, 1);
        read_into(file, &count, 1);
        field.first_child_.resize(count);
        field.corners_.resize(count);
        read_into(file, field.first_child_.data(), count);
        read_into(file, field.corners_.data(), count);
        if (!file) throw std::runtime_error(path + ": ends before its cells do");
        for (auto& values : field.corners_)
            for (double& value : values) value *= scale;
        return field;
    }

    double at(double x, double y) const {
        x = std::clamp((x - x0_) / side_, 0.0, 1.0);
        y = std::clamp((y - y0_) / side_, 0.0, 1.0);
        std::size_t cell = 0;
        while (first_child_[cell] >= 0) {
            x *= 2.0;
            y *= 2.0;
            const bool right = x >= 1.0, above = y >= 1.0;
            x -= right;
            y -= above;
            cell = static_cast<std::size_t>(first_child_[cell]) + right + 2 * above;
        }
        const auto& value = corners_[cell];
        const double below = value[0] + x * (value[1] - value[0]);
        const double above = value[2] + x * (value[3] - value[2]);
        return below + y * (above - below);
    }

  private:
    template <class T>
    static void read_into(std::ifstream& file, T* values, std::size_t count) {
        file.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
    }

    double x0_ = 0.0, y0_ = 0.0, side_ = 0.0;
    std::vector<std::int32_t> first_child_;
    std::vector<std::array<double, 4>> corners_;
};
