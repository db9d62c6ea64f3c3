#pragma once
/// Runs of places in the local arrays: loops over the cells that matter, where these are few.
#include <cstddef>
#include <vector>

#include "numerics/loops.hpp"

namespace mudlark {

/// Places first ... last - 1 of one row along the first axis.
struct Span {
  std::ptrdiff_t first, last;
  friend bool operator==(const Span&, const Span&) = default;
};
using Spans = std::vector<Span>;

/// Calls body(at) for every place of the spans.
template <class Body>
inline void for_each_offset(const Spans& spans, Body&& body) {
  for (const Span& span : spans)
    for (std::ptrdiff_t at = span.first; at < span.last; ++at) body(at);
}

/// Adds the spans of places at which `taken(at)` holds among first ... last - 1.
template <class Taken>
inline void add_spans(std::ptrdiff_t first, std::ptrdiff_t last, Taken&& taken, Spans& spans) {
  for (std::ptrdiff_t at = first; at < last; ++at) {
    if (!taken(at)) continue;
    const std::ptrdiff_t start = at;
    while (at < last && taken(at)) ++at;
    spans.push_back({start, at});
  }
}

/// Spans of a box's places at which `taken(at)` holds, row after row.
template <class Layout, int D, class Taken>
void find_spans(const Layout& layout, const IndexBox<D>& box, Taken&& taken, Spans& spans) {
  spans.clear();
  if (box.empty()) return;
  IndexBox<D> rows = box;
  rows.upper[0] = rows.lower[0] + 1;
  for_each(rows, [&](const Index<D>& row) {
    const std::ptrdiff_t start = layout.offset(row);
    add_spans(start, start + (box.upper[0] - box.lower[0]), taken, spans);
  });
}

}  // namespace mudlark
