#include "compiler/driver/dimmed_triangles.h"

#include <utility>

namespace orbc::driver {
namespace {

/// What the vertices and triangles of a product become, entry by entry.
struct SplitProduct {
  std::vector<ProductCopy> copies;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::uint32_t> indices;
};

/// Appends the vertices and triangles of one kind of an entry.
void append(const Product& from, const ProductCopy& copy, double first_dimmed_v, bool dimmed, SplitProduct& to) {
  ProductCopy entry = copy;
  entry.first_vertex = to.positions.size(), entry.first_index = to.indices.size();
  std::vector<std::uint32_t> renumbered(copy.vertex_count, 0);
  const auto is_dimmed = [&](std::size_t v) { return static_cast<double>(from.uv[v][1]) >= first_dimmed_v; };
  for (std::size_t i = 0; i < copy.vertex_count; ++i) {
    const std::size_t v = copy.first_vertex + i;
    if (is_dimmed(v) != dimmed) continue;
    renumbered[i] = static_cast<std::uint32_t>(to.positions.size());
    to.positions.push_back(from.positions[v]);
    to.uv.push_back(from.uv[v]);
  }
  for (std::size_t i = copy.first_index; i < copy.first_index + copy.index_count; i += 3) {
    if (is_dimmed(from.indices[i]) != dimmed) continue;
    for (std::size_t k = 0; k < 3; ++k) to.indices.push_back(renumbered[from.indices[i + k] - copy.first_vertex]);
  }
  entry.vertex_count = to.positions.size() - entry.first_vertex;
  entry.index_count = to.indices.size() - entry.first_index;
  if (dimmed && entry.index_count == 0) {
    to.positions.resize(entry.first_vertex);
    to.uv.resize(entry.first_vertex);
    return;
  }
  if (dimmed) entry.weight = {1, 1, 1};
  to.copies.push_back(std::move(entry));
}

}  // namespace

Product split_dimmed_triangles(Product product, double first_dimmed_v) {
  if (first_dimmed_v > 1) return product;
  SplitProduct split;
  std::vector<std::size_t> place(product.copies.size());  // of each entry in the new list
  for (std::size_t first = 0; first < product.copies.size();) {
    std::size_t end = first;  // of the entries of an object
    while (end < product.copies.size() && product.copies[end].object == product.copies[first].object) ++end;
    for (std::size_t i = first; i < end; ++i) {
      place[i] = split.copies.size();
      ProductCopy copy = product.copies[i];
      if (copy.duplicate_of) copy.duplicate_of = place[*copy.duplicate_of];
      append(product, copy, first_dimmed_v, false, split);
    }
    for (std::size_t i = first; i < end; ++i) {
      ProductCopy copy = product.copies[i];
      copy.duplicate_of = copy.duplicate_of ? place[*copy.duplicate_of] : place[i];
      append(product, copy, first_dimmed_v, true, split);
    }
    first = end;
  }
  product.copies = std::move(split.copies);
  product.positions = std::move(split.positions);
  product.uv = std::move(split.uv);
  product.indices = std::move(split.indices);
  return product;
}

}  // namespace orbc::driver
