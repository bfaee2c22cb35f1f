#pragma once
// Packed cells kept on disk, so that a cell is packed once a user, not once a process.
//
//   $XDG_CACHE_HOME/standoff/cells/KEY.cell, else $HOME/.cache/standoff/cells/KEY.cell
//
// KEY is a hash of all that determines a cell: the options and the program itself, byte for byte. A program built anew
// packs anew, so a stale file is never read. A file holds a checksum; one that is cut short or changed is not believed.
// Files are written beside their place and renamed, so writers at the same time do not meet. No folder, no right to
// write, a full disk, STANDOFF_CELL_CACHE=off: cells are packed, nothing else changes.
#include <optional>
#include <string>

#include "particle_solver/packing/packed_cell.hpp"

namespace standoff::particles {

/// Where this user's cells are; "" for nowhere.
std::string cell_cache_folder();

/// Name of the file of a cell, without the folder.
std::string cell_file_name(const PackedCellOptions& options);

std::optional<PackedCell> load_cell(const std::string& path);
/// Quiet if it cannot be written.
void store_cell(const std::string& path, const PackedCell& cell);

}  // namespace standoff::particles
