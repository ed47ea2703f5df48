// Shader programs: compiled and linked from text, with the driver's log in the error, and uniforms set by
// name.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gl/objects.h"

namespace stairstep::gl {

/// The parts of one shader, joined in order; the first starts with #version. The driver numbers each part's
/// lines from 1 and the part from 0, so the log's "1:12" is line 12 of the second part.
using ShaderParts = std::vector<std::string_view>;

/// `name` stands for the program in errors. Throws FailureError with the driver's log.
Program make_program(const std::string& name, const ShaderParts& vertex, const ShaderParts& fragment);

/// Sets a uniform; one that the program doesn't use is skipped, as compilers drop what has no effect.
void set_uniform(const Program& program, const char* name, int value);
void set_uniform(const Program& program, const char* name, float value);
void set_uniform(const Program& program, const char* name, const glm::vec2& value);
void set_uniform(const Program& program, const char* name, const glm::vec3& value);
void set_uniform(const Program& program, const char* name, const glm::mat3& value);
void set_uniform(const Program& program, const char* name, std::span<const glm::vec4> values);
void set_uniform(const Program& program, const char* name, const glm::mat4& value);

}  // namespace stairstep::gl
