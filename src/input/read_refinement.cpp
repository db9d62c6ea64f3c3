/// [[domain.refinement]]
#include <fmt/format.h>

#include <algorithm>

#include "grid/stretching.hpp"
#include "input/sections.hpp"

namespace mudlark {
namespace {

/// More than that and the second order of the scheme is lost.
constexpr double largest_growth = 1.3;
/// Fine cells that one region may have along its axis: more fit into no memory.
constexpr double most_cells = 1e6;

struct Region {
  Section section;
  std::size_t axis;
  Refinement refinement;
};

/// Keys of one region; the axis of a mistake is the number of axes.
Region read_region(Section section, const DomainOptions& domain) {
  const auto axes = static_cast<std::size_t>(domain.dimension);
  std::vector<Choice<std::size_t>> names;
  for (std::size_t a = 0; a < axes; ++a)
    names.push_back({std::string(axis_name(domain.dimension, a)), a});
  const auto axis = section.choice<std::size_t>("axis", names);
  const double lower = domain.lower[axis], upper = domain.upper[axis];
  const std::string extent = fmt::format("the domain reaches from {:g} to {:g} m along {}", lower,
                                         upper, names[axis].name);
  Refinement r;
  r.from =
      section.number("from", quantity::length,
                     {.lower = lower, .upper = upper, .upper_included = false, .reason = extent});
  r.to = section.number("to", quantity::length,
                        {.lower = std::max(lower, r.from),
                         .upper = upper,
                         .lower_included = false,
                         .reason = extent + ", and a region ends after its beginning"});
  const double coarse = (upper - lower) / domain.cells[axis];
  r.size = section.number("cell_size", quantity::length,
                          {.lower = 0.0,
                           .upper = coarse,
                           .lower_included = false,
                           .reason = fmt::format("cells elsewhere are {:.4g} m", coarse),
                           .cure = "A refinement has smaller cells."});
  if ((r.to - r.from) / r.size > most_cells)
    section.fail("cell_size",
                 fmt::format("that makes {:.3g} cells along the region, at most {:.0e} "
                             "are possible",
                             (r.to - r.from) / r.size, most_cells),
                 "Write a larger size or a shorter region.");
  r.growth = section.number("growth", quantity::number,
                            {.lower = 1.0,
                             .upper = largest_growth,
                             .lower_included = false,
                             .reason = "the ratio of neighbouring cells outside the region"},
                            1.1);
  section.finish();
  return {section, axis, r};
}

/// A periodic axis would have to fit where its ends meet.
bool refinable(Region& region, const DomainOptions& domain) {
  if (domain.walls[region.axis][0] != Wall::periodic) return true;
  region.section.fail("axis", "this axis is periodic", "Its cells have one size.");
  return false;
}

/// Regions of one axis from left to right; false when they overlap.
bool apart(std::vector<Region*>& regions) {
  std::sort(regions.begin(), regions.end(), [](const Region* a, const Region* b) {
    return a->refinement.from < b->refinement.from;
  });
  for (std::size_t i = 1; i < regions.size(); ++i)
    if (regions[i]->refinement.from < regions[i - 1]->refinement.to) {
      regions[i]->section.fail("from",
                               fmt::format("another region of this axis reaches to {:g} m",
                                           regions[i - 1]->refinement.to),
                               "Let one end where the next begins.");
      return false;
    }
  return true;
}

}  // namespace

void read_refinements(Section& section, DomainOptions& domain, bool domain_known) {
  if (!section.has("refinement")) return;
  std::vector<Section> sections = section.tables("refinement");
  if (!domain_known) return;
  const std::size_t mistakes = section.reading().report.size();
  std::vector<Region> regions;
  for (const Section& one : sections) regions.push_back(read_region(one, domain));
  if (section.reading().report.size() > mistakes) return;
  for (std::size_t a = 0; a < static_cast<std::size_t>(domain.dimension); ++a) {
    std::vector<Region*> here;
    for (Region& region : regions)
      if (region.axis == a && refinable(region, domain)) here.push_back(&region);
    if (here.empty() || !apart(here)) continue;
    std::vector<Refinement> refinements;
    for (const Region* region : here) refinements.push_back(region->refinement);
    domain.faces[a] =
        graded_faces(domain.lower[a], domain.upper[a],
                     (domain.upper[a] - domain.lower[a]) / domain.cells[a], refinements);
    domain.cells[a] = static_cast<int>(domain.faces[a].size()) - 1;
  }
}

}  // namespace mudlark
