// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <asperity/formats/results/tensor_file.h>

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <initializer_list>
#include <new>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

/// Fields of an open container as numbers and texts. All functions throw as TensorFile.
class FieldReader {
  public:
    explicit FieldReader(const TensorFile& file) : file_(file) {}

  protected:
    using Shape = std::vector<std::uint64_t>;

    static std::uint64_t extent(int count) { return static_cast<std::uint64_t>(count); }

    const TensorField& field(const char* name, TensorType type, const Shape& shape) const {
        const TensorField& field = file_.require(name, type, shape.size());
        if (field.shape != shape)
            file_.fail(field.entry, fmt::format("field '{}' does not have the shape of the "
                                                "experiment",
                                                name));
        return field;
    }

    template <typename T>
    std::vector<T> values(const char* name, TensorType type, const Shape& shape) const {
        const TensorField& found = field(name, type, shape);
        std::vector<T> numbers(static_cast<std::size_t>(found.bytes) / sizeof(T));
        file_.read(found, 0, std::as_writable_bytes(std::span(numbers)));
        return numbers;
    }

    std::string text(const char* name) const {
        const TensorField& found = file_.require(name, TensorType::U8, 1);
        if (found.bytes > kMaxTextBytes)
            file_.fail(found.entry, fmt::format("field '{}' is too long for a text", name));
        std::string characters(static_cast<std::size_t>(found.bytes), '\0');
        file_.read(found, 0, std::as_writable_bytes(std::span(characters)));
        return characters;
    }

    // Whatever the text does not say right becomes an error about its field.
    template <typename Read>
    void try_reading(const char* name, Read&& read) const {
        const std::string characters = text(name);
        try {
            read(characters);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& error) {
            file_.fail(file_.find(name)->offset, fmt::format("field '{}': {}", name, error.what()));
        }
    }

    // part(owner) of each gets as much as the others.
    template <typename Owner, typename Part>
    void read_each(const char* name, TensorType type, const Shape& shape,
                   std::vector<Owner>& owners, Part part) {
        const TensorField& found = field(name, type, shape);
        std::vector<std::span<std::byte>> parts(owners.size());
        // What takes time is that the system gives pages of memory
        const int threads = found.bytes < (1 << 20) ? 1 : Run().threads();
        parallel_for(owners.size(), threads, [&](std::size_t k) {
            auto& numbers = part(owners[k]);
            numbers.resize(static_cast<std::size_t>(found.bytes / owners.size()) /
                           sizeof(numbers[0]));
            parts[k] = std::as_writable_bytes(std::span(numbers));
        });
        file_.read_parts(found, parts);
    }

    const TensorField& first_of(std::initializer_list<const char*> names) const {
        for (const char* name : names)
            if (const TensorField* found = file_.find(name)) return *found;
        return file_.fields().front();
    }

    const TensorFile& file_;

  private:
    static constexpr std::uint64_t kMaxTextBytes = 16 << 20;
};

}  // namespace asperity::io
