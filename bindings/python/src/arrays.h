// SPDX-License-Identifier: Apache-2.0
// Arrays that Python sees and the library's memory.
#pragma once

#include <asperity/core/vec.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace asperity::python {

namespace nb = nanobind;

/// An array of NumPy that owns what the vector held.
template <typename T>
nb::ndarray<nb::numpy, T> to_array(std::vector<T> values,
                                   std::initializer_list<std::size_t> shape) {
    auto holder = std::make_unique<std::vector<T>>(std::move(values));
    T* data = holder->data();
    nb::capsule owner(holder.release(),
                      [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    return nb::ndarray<nb::numpy, T>(data, shape, owner);
}

/// Numbers to be written, each of them: nobody sets them to zero before.
template <typename T>
struct Buffer {
    explicit Buffer(std::size_t count)
        : values(std::make_unique_for_overwrite<T[]>(count)), size(count) {}

    std::span<T> span() { return {values.get(), size}; }
    /// Gives the memory to an array of NumPy.
    nb::ndarray<nb::numpy, T> to_array(std::initializer_list<std::size_t> shape) && {
        T* data = values.release();
        nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<T*>(p); });
        return nb::ndarray<nb::numpy, T>(data, shape, owner);
    }

    std::unique_ptr<T[]> values;
    std::size_t size;
};

/// A view, not to be written to, of memory that `keeper` keeps alive.
template <typename T, typename Keeper>
nb::ndarray<nb::numpy, const T> to_view(const T* data, std::initializer_list<std::size_t> shape,
                                        std::shared_ptr<const Keeper> keeper) {
    auto holder = std::make_unique<std::shared_ptr<const Keeper>>(std::move(keeper));
    nb::capsule owner(holder.release(), [](void* p) noexcept {
        delete static_cast<std::shared_ptr<const Keeper>*>(p);
    });
    return nb::ndarray<nb::numpy, const T>(data, shape, owner);
}

/// Directions as Python gives them: rows of x, y, z, or one row that serves all.
using Directions = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

inline Vec3 direction(const double* rows, std::size_t count, std::size_t k) {
    const double* row = rows + 3 * (count == 1 ? 0 : k);
    return {row[0], row[1], row[2]};
}

}  // namespace asperity::python
