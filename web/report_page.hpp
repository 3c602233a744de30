#pragma once

#include <string>

namespace cairn::web {

/// The template of the report (report.html with script and style in it), or empty where the build had no npm.
std::string report_page();

/// The template of a campaign's page; empty as well.
std::string campaign_page();

/// Why report_page() is empty and what to do about it; empty where it is there.
std::string why_no_report_page();

}  // namespace cairn::web
