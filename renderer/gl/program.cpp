#include "renderer/gl/program.h"

#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "stimuli/error.h"

namespace stairstep::gl {
namespace {

Shader compile(GLenum stage, const std::string& name, const ShaderParts& parts) {
    std::vector<const char*> texts;
    std::vector<GLint> lengths;
    for (const std::string_view part : parts) {
        texts.push_back(part.data());
        lengths.push_back(static_cast<GLint>(part.size()));
    }
    Shader shader(CreateShader(stage));
    ShaderSource(shader.id(), static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
    CompileShader(shader.id());
    GLint ok = 0;
    GetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
    if (!ok) {
        std::string log(4096, '\0');
        GLsizei length = 0;
        GetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(length);
        const char* stage_name = stage == GL_VERTEX_SHADER ? " vertex shader" : " fragment shader";
        throw FailureError(name + stage_name, "doesn't compile: " + log, "please report this with your driver's name");
    }
    return shader;
}

GLint location(const Program& program, const char* name) {
    return GetUniformLocation(program.id(), name);
}

}  // namespace

Program make_program(const std::string& name, const ShaderParts& vertex, const ShaderParts& fragment) {
    const Shader vertex_shader = compile(GL_VERTEX_SHADER, name, vertex);
    const Shader fragment_shader = compile(GL_FRAGMENT_SHADER, name, fragment);
    Program program(CreateProgram());
    AttachShader(program.id(), vertex_shader.id());
    AttachShader(program.id(), fragment_shader.id());
    LinkProgram(program.id());
    GLint ok = 0;
    GetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (!ok) {
        std::string log(4096, '\0');
        GLsizei length = 0;
        GetProgramInfoLog(program.id(), static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(length);
        throw FailureError(name + " program", "doesn't link: " + log, "please report this with your driver's name");
    }
    return program;
}

// GL ignores the location −1 that an unused name has.
void set_uniform(const Program& program, const char* name, int value) {
    ProgramUniform1i(program.id(), location(program, name), value);
}
void set_uniform(const Program& program, const char* name, float value) {
    ProgramUniform1f(program.id(), location(program, name), value);
}
void set_uniform(const Program& program, const char* name, const glm::vec2& value) {
    ProgramUniform2f(program.id(), location(program, name), value.x, value.y);
}
void set_uniform(const Program& program, const char* name, const glm::vec3& value) {
    ProgramUniform3f(program.id(), location(program, name), value.x, value.y, value.z);
}
void set_uniform(const Program& program, const char* name, const glm::mat3& value) {
    ProgramUniformMatrix3fv(program.id(), location(program, name), 1, GL_FALSE, glm::value_ptr(value));
}
void set_uniform(const Program& program, const char* name, std::span<const glm::vec4> values) {
    ProgramUniform4fv(program.id(), location(program, name), static_cast<GLsizei>(values.size()),
                      glm::value_ptr(values.front()));
}
void set_uniform(const Program& program, const char* name, const glm::mat4& value) {
    ProgramUniformMatrix4fv(program.id(), location(program, name), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace stairstep::gl
