#include "apps/cairn/campaign_folder.hpp"

#include "apps/cairn/run_directory.hpp"
#include "cairn/core/errors.hpp"

#include <array>
#include <csignal>

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCells = "cells";
constexpr const char* kWorking = "working";

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "host";
  return name.data();
}

void check_folder(const fs::path& path) {
  if (path.empty()) throw ConfigurationError("--out", "is empty", "name a folder");
  if (!fs::exists(path)) return;
  if (!fs::is_directory(path))
    throw ConfigurationError(path.string(), "is a file, not a folder", "choose another --out");
  if (!fs::is_empty(path) && !fs::is_directory(path / kCells)) {
    throw ConfigurationError(path.string(), "holds files that are not those of a campaign",
                             "choose an empty or new folder for --out");
  }
}

// A rename is only safe against a power cut when the bytes are on the disk before it.
void flush_to_disk(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  fsync(file);
  close(file);
}

}  // namespace

CampaignFolder::CampaignFolder(const fs::path& path) : path_(path) {
  check_folder(path);
  working_ = path / kWorking / fmt::format("{}-{}", host_name(), getpid());
  try {
    for (const char* name : {kCells, "logs", kWorking}) fs::create_directories(path / name);
    remove_leftovers();
    fs::remove_all(working_);
    fs::create_directories(working_);
  } catch (const fs::filesystem_error& error) {
    throw InputError(path.string(), error.code().message(), "choose another --out or make room there");
  }
}

CampaignFolder::~CampaignFolder() {
  std::error_code ignored;
  fs::remove_all(working_, ignored);
}

void CampaignFolder::remove_leftovers() const {
  const std::string prefix = host_name() + "-";
  for (const auto& entry : fs::directory_iterator(path_ / kWorking)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(prefix, 0) != 0) continue;  // another machine's
    const std::string digits = name.substr(prefix.size());
    if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos)
      continue;
    const bool gone = kill(std::stoi(digits), 0) != 0 && errno == ESRCH;
    if (gone) fs::remove_all(entry.path());
  }
}

bool CampaignFolder::has_cell(const std::string& id) const { return fs::is_regular_file(cell_file(id)); }

std::optional<CellResult> CampaignFolder::read_cell(const std::string& id) const {
  if (!has_cell(id)) return std::nullopt;
  const fs::path path = cell_file(id);
  CellResult result = cell_result_from_json(read_file(path), path.string());
  if (result.id != id) throw InputError(path.string(), "is the result of another cell", "remove it");
  return result;
}

void CampaignFolder::write_cell(const CellResult& result) const {
  const fs::path made = working_ / (result.id + ".json");
  write_file(made, to_json(result));
  flush_to_disk(made);
  fs::rename(made, cell_file(result.id));
}

void CampaignFolder::keep_log(const fs::path& made, const std::string& id) const {
  const fs::path kept = logs() / id;
  std::error_code error;
  fs::rename(made, kept, error);
  if (!error) return;
  // Another process was faster: its recording is the same.
  if (!fs::is_directory(kept))
    throw InputError(kept.string(), error.message(), "look at the permissions there");
  fs::remove_all(made);
}

void CampaignFolder::keep_failure(const fs::path& output, const std::string& id) const {
  fs::create_directories(path_ / "failed");
  fs::rename(output, path_ / "failed" / (id + ".txt"));
}

std::size_t CampaignFolder::take_cells_of(const fs::path& other) const {
  if (!fs::is_directory(other / kCells)) {
    throw InputError(other.string(), "is no folder of a campaign", "name the --out folder of a share");
  }
  std::size_t taken = 0;
  for (const auto& entry : fs::directory_iterator(other / kCells)) {
    const std::string id = entry.path().stem().string();
    if (entry.path().extension() != ".json" || has_cell(id)) continue;
    write_cell(cell_result_from_json(read_file(entry.path()), entry.path().string()));
    ++taken;
  }
  return taken;
}

}  // namespace cairn::app
