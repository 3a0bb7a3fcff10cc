// What one atlas comes to where the work is stopped before it has begun.
#include "one_atlas.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace atlas_refine {
namespace {

Outcome stopped_before_it_began(const RefineOptions& options) {
  const InputAtlas input = read_atlas(shapes::mesh(shapes::s_shape(), 0.08), options);
  Monitor monitor;
  monitor.finish();
  Journal journal(monitor, nullptr, options.box_aspect);
  return refine_one(input, options, {}, monitor, journal);
}

TEST(OneAtlas, StoppedBeforeItBeganIsLeftAsItIs) {
  for (const Seams seams : {Seams::None, Seams::Needed, Seams::Rectangles}) {
    const Outcome outcome = stopped_before_it_began({.pe_bound = 0.95, .seams = seams});
    EXPECT_EQ(outcome.ended, Ended::Stopped);
    EXPECT_EQ(outcome.intervention, Intervention::Unchanged);
    EXPECT_EQ(outcome.after.pe, outcome.before.pe);
    EXPECT_FALSE(outcome.bound_met);
    EXPECT_FALSE(outcome.reason.empty());
  }
}

}  // namespace
}  // namespace atlas_refine
