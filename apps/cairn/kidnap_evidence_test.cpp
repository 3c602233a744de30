#include "apps/cairn/kidnap_evidence.hpp"

#include "cairn/core/angle.hpp"
#include "mini_maps.hpp"
#include "small_room.hpp"

#include <gtest/gtest.h>

namespace cairn::app {
namespace {

using test::at;

// Three metres along a wall, seen every 0.2 m.
class KidnapEvidence : public ::testing::Test {
 protected:
  explicit KidnapEvidence(OccupancyGrid map = test::mini_room()) : map_(std::move(map)) {
    const std::vector<StreamInfo> streams{{"laser", StreamKind::kLaserScan, "", Pose2{}}};
    options_.odometry_stream = "none";
    bound_ = bind_streams(options_, streams, MapLibrary(map_));
    for (int i = 0; i <= 15; ++i) {
      reference_.push_back({at(i), kStart * Pose2{0.2 * i, 0.0, 0.0}});
      LaserScan scan = test::scan_of(map_, reference_.back().pose, 180);
      scan.stamp = at(i);
      events_.push_back(test::scan_event(std::move(scan), 0));
    }
  }

  std::optional<double> against(const Pose2& believed_at_end) const {
    return evidence_for_truth(events_, bound_, reference_, {at(0), at(15), believed_at_end},
                              options_.recovery);
  }

  static constexpr Pose2 kStart{1.5, 1.2, 0.0};
  OccupancyGrid map_;
  LocalizerOptions options_;
  StreamBindings bound_;
  std::vector<Event> events_;
  Trajectory reference_;
};

TEST_F(KidnapEvidence, TheScansSpeakForTheTrueWay) { EXPECT_GT(*against({2.0, 4.0, -1.0}), 20.0); }

TEST_F(KidnapEvidence, NothingSpeaksForTheTruthAgainstItself) {
  EXPECT_NEAR(*against(reference_.back().pose), 0.0, 1e-9);
}

TEST_F(KidnapEvidence, IsUnknownWhereTheReferenceEnds) {
  reference_.pop_back();
  EXPECT_EQ(against({2.0, 4.0, -1.0}), std::nullopt);
}

// Maps onto itself by half a turn about its middle: nobody can tell the two ways apart.
class KidnapEvidenceInASymmetricRoom : public KidnapEvidence {
 protected:
  static OccupancyGrid symmetric_room() {
    std::vector<OccupancyGrid::Cell> cells(160 * 100, 0);
    for (int row = 0; row < 100; ++row) {
      for (int column = 0; column < 160; ++column) {
        if (row == 0 || row == 99 || column == 0 || column == 159)
          cells[static_cast<std::size_t>(row * 160 + column)] = 100;
      }
    }
    return {{160, 100, 0.05, {}}, std::move(cells)};
  }
  KidnapEvidenceInASymmetricRoom() : KidnapEvidence(symmetric_room()) {}
};

TEST_F(KidnapEvidenceInASymmetricRoom, LooksTheSameFromTheTwinPlace) {
  const Pose2 end = reference_.back().pose;
  const Pose2 twin{8.0 - end.x, 5.0 - end.y, kPi};
  EXPECT_NEAR(*against(twin), 0.0, 1.0);
}

}  // namespace
}  // namespace cairn::app
