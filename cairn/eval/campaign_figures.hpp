#pragma once

#include "cairn/eval/campaign_tables.hpp"

#include <string>
#include <vector>

namespace cairn {

struct CampaignFigure {
  std::string name;  ///< of the file, without ending: letters, digits, `-` and `_`
  std::string svg;
};

/// The results as pictures for documents. Task localize: for each input the error over the map of the
/// baseline (as Biswas & Veloso, IROS 2013, Fig. 2), the distribution of the errors of all variants, the
/// share of runs within 1 m over time, the histogram of the errors at the end (Fig. 4b) and, where the start
/// is not known, the share of runs that have converged over time; and, where recipes have several sets of
/// parameters, error and computing time of each (`cost`). Task sensors: for each input the distributions of
/// the sensors' errors, real and simulated.
std::vector<CampaignFigure> campaign_figures(const CampaignReport& report);

/// Mean distance of two distributions that are told by the same number of evenly spread quantiles
/// (Wasserstein-1).
/// @pre both of the same size, not empty
double distribution_distance(std::span<const double> a, std::span<const double> b);

/// Mean quantiles of an input's cells of one variant; empty if none has the distribution.
std::vector<double> mean_quantiles(const CampaignReport& report, const std::string& input,
                                   const std::string& variant, const std::string& distribution);

}  // namespace cairn
