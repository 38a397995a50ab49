// The published JSON schema of .sdf.json.
#pragma once

#include <string>

namespace edgewise::sdf {

/// The text of data/sdf.schema.json: draft 2020-12, made of the same tables that the reader obeys.
std::string schemaText();

}  // namespace edgewise::sdf
