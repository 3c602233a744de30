#include "cairn/eval/campaign.hpp"

#include "cairn/core/errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;

Campaign small_campaign() {
  Campaign campaign;
  campaign.seeds = "3..4";
  campaign.inputs.resize(2);
  campaign.inputs[0].name = "a";
  campaign.inputs[0].world = "office";
  campaign.inputs[1].name = "b";
  campaign.inputs[1].log = "b.log";
  campaign.inputs[1].map = "b.yaml";
  campaign.inputs[1].start = "global";
  return campaign;
}

std::string refusal(Campaign campaign) {
  try {
    campaign.validate();
  } catch (const ConfigurationError& error) {
    return error.where();
  }
  return "accepted";
}

TEST(Campaign, SeedsAreRangesAndLists) {
  EXPECT_THAT(parse_seeds("seeds", "1..3"), ElementsAre(1, 2, 3));
  EXPECT_THAT(parse_seeds("seeds", "5, 2,7..8"), ElementsAre(5, 2, 7, 8));
  EXPECT_THAT(parse_seeds("seeds", "18446744073709551615"), ElementsAre(18446744073709551615ULL));
  EXPECT_THAT(parse_seeds("seeds", "18446744073709551614..18446744073709551615"),
              ElementsAre(18446744073709551614ULL, 18446744073709551615ULL));
}

TEST(Campaign, RefusesSeedsThatAreNone) {
  for (const char* text :
       {"", "a", "1..", "..3", "3..1", "1,1", "1..3,2", "-1", "1.5", "1..99999999", "1,,2"}) {
    EXPECT_THROW(parse_seeds("seeds", text), ConfigurationError) << text;
  }
}

TEST(Campaign, CellsAreTheProduct) {
  Campaign campaign = small_campaign();
  campaign.recipes = "mcl kld_mcl";
  campaign.validate();
  const std::vector<CampaignCell> cells = campaign.cells();
  ASSERT_EQ(cells.size(), 8U);
  EXPECT_EQ(cells[0].recipe, "mcl");
  EXPECT_EQ(cells[1].seed, 4U);
  EXPECT_EQ(cells[2].recipe, "kld_mcl");
  EXPECT_EQ(cells[4].input, 1U);
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i].index, i);
}

TEST(Campaign, VariantsAreNamedByWhatVaries) {
  Campaign campaign = small_campaign();
  campaign.validate();
  EXPECT_EQ(campaign.cells().front().variant, "default");
  campaign.recipes = "mcl";
  EXPECT_EQ(campaign.cells().front().variant, "mcl");
  campaign.parameters.emplace_back().name = "many";
  EXPECT_EQ(campaign.cells().back().variant, "many");
  campaign.recipes = "mcl kld_mcl";
  EXPECT_EQ(campaign.cells().back().variant, "kld_mcl many");
}

TEST(Campaign, ErrorsNameTheKey) {
  EXPECT_EQ(refusal(small_campaign()), "accepted");
  EXPECT_EQ(refusal(Campaign()), "inputs");
  const auto change = [](auto edit) {
    Campaign campaign = small_campaign();
    edit(campaign);
    return refusal(campaign);
  };
  EXPECT_EQ(change([](Campaign& c) { c.inputs[0].world.clear(); }), "inputs.a");
  EXPECT_EQ(change([](Campaign& c) { c.inputs[0].log = "x"; }), "inputs.a");
  EXPECT_EQ(change([](Campaign& c) { c.inputs[0].map = "x"; }), "inputs.a.world");
  EXPECT_EQ(change([](Campaign& c) { c.inputs[1].map.clear(); }), "inputs.b.map");
  EXPECT_EQ(change([](Campaign& c) { c.inputs[1].start = "reference"; }), "inputs.b.start");
  EXPECT_EQ(change([](Campaign& c) { c.inputs[0].world_seed = "x"; }), "inputs.a.world_seed");
  EXPECT_EQ(change([](Campaign& c) { c.inputs[0].settings.set = "particles"; }), "inputs.a.set");
  EXPECT_EQ(change([](Campaign& c) { c.seeds = "x"; }), "seeds");
  EXPECT_EQ(change([](Campaign& c) { c.baseline = "none"; }), "baseline");
  EXPECT_EQ(change([](Campaign& c) {
              c.recipes = "a b c d e f";
              c.seeds = "1..10000";
            }),
            "seeds");
}

Campaign sensor_campaign() {
  Campaign campaign;
  campaign.task = kTaskSensors;
  campaign.seeds = "3..4";
  campaign.inputs.resize(1);
  CampaignInput& input = campaign.inputs[0];
  input.name = "a";
  input.log = "a.log";
  input.map = "a.yaml";
  input.reference = "a.tum";
  input.world = "w.yaml";
  return campaign;
}

TEST(Campaign, SensorsAreMeasuredOnceInTheLogAndWithEverySeedInTheWorld) {
  Campaign campaign = sensor_campaign();
  campaign.validate();
  const std::vector<CampaignCell> cells = campaign.cells();
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_EQ(cells[0].variant, kVariantReal);
  EXPECT_EQ(cells[1].variant, kVariantSimulated);
  EXPECT_EQ(cells[2].seed, 4U);
}

TEST(Campaign, SensorsNeedLogAndWorldAndNoRecipe) {
  const auto changed = [](auto change) {
    Campaign campaign = sensor_campaign();
    change(campaign);
    return refusal(campaign);
  };
  EXPECT_EQ(changed([](Campaign& c) { c.inputs[0].world = ""; }), "inputs.a");
  EXPECT_EQ(changed([](Campaign& c) { c.inputs[0].reference = ""; }), "inputs.a");
  EXPECT_EQ(changed([](Campaign& c) { c.recipes = "mcl"; }), "recipes");
  EXPECT_EQ(changed([](Campaign& c) { c.parameters.emplace_back().name = "few"; }), "parameters");
}

}  // namespace
}  // namespace cairn
