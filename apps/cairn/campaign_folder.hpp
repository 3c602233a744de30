#pragma once

#include "cairn/eval/cell_result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cairn::app {

/// The folder of a campaign:
///
///     cells/ID.json     a finished cell; appears whole or not at all
///     logs/ID/          a simulated recording; likewise
///     failed/ID.txt     what a cell that failed printed; it is run again next time
///     working/HOST-PID/ what the process with that number is doing; removed when it is gone
///     results.csv results.json tables.md index.html
class CampaignFolder {
 public:
  /// Makes the folders that are missing, and removes what processes of this machine left that are no more.
  /// @throws ConfigurationError for a folder that holds something else; InputError where the disk refuses
  explicit CampaignFolder(const std::filesystem::path& path);
  ~CampaignFolder();  ///< removes its working folder
  CampaignFolder(const CampaignFolder&) = delete;
  CampaignFolder& operator=(const CampaignFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path logs() const { return path_ / "logs"; }
  const std::filesystem::path& working() const { return working_; }

  bool has_cell(const std::string& id) const;
  /// nullopt if the cell is not finished.
  /// @throws InputError for a file that is not the result of this cell
  std::optional<CellResult> read_cell(const std::string& id) const;
  void write_cell(const CellResult& result) const;

  /// Takes over a finished folder below working() as logs/`id`.
  void keep_log(const std::filesystem::path& made, const std::string& id) const;
  void keep_failure(const std::filesystem::path& output, const std::string& id) const;

  /// Copies the finished cells of another folder that are not here. Returns how many.
  /// @throws InputError if it is no folder of a campaign
  std::size_t take_cells_of(const std::filesystem::path& other) const;

 private:
  std::filesystem::path cell_file(const std::string& id) const { return path_ / "cells" / (id + ".json"); }
  void remove_leftovers() const;

  std::filesystem::path path_;
  std::filesystem::path working_;
};

}  // namespace cairn::app
