// The OpenGL functions that Stairstep calls, as a table filled at run time: gl::BindTexture(…) is
// glBindTexture. Each thread has its own table, as it has its own current context (context.h).
//
// A new call is one more word in the list. Each entry has the exact type that glcorearb.h declares.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <functional>

// clang-format off
#define STAIRSTEP_GL_FUNCTIONS(X) \
    X(AttachShader) X(BeginQuery) X(BindBuffer) X(BindBufferBase) X(BindFramebuffer) X(BindTextureUnit) \
    X(BindVertexArray) X(BlitNamedFramebuffer) X(CheckNamedFramebufferStatus) X(ClearNamedFramebufferfv) \
    X(ClipControl) X(CompileShader) X(CopyImageSubData) X(CreateBuffers) X(CreateFramebuffers) X(CreateProgram) X(CreateQueries) \
    X(CreateShader) X(CreateTextures) X(CreateVertexArrays) X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) \
    X(DeleteQueries) X(DeleteShader) X(DeleteTextures) X(DeleteVertexArrays) X(Disable) X(DrawArrays) \
    X(Enable) X(EnableVertexArrayAttrib) X(EndQuery) X(Finish) X(GenerateTextureMipmap) X(GetError) \
    X(GetIntegerv) X(GetNamedBufferSubData) X(GetProgramInfoLog) X(GetProgramiv) X(GetQueryObjectui64v) \
    X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetTextureImage) X(GetUniformLocation) X(LinkProgram) X(MultiDrawElements) \
    X(NamedBufferStorage) X(NamedFramebufferDrawBuffers) X(NamedFramebufferReadBuffer) \
    X(NamedFramebufferTexture) X(PixelStorei) X(ProgramUniform1f) X(ProgramUniform1i) X(ProgramUniform2f) \
    X(ProgramUniform3f) X(ProgramUniform4fv) X(ProgramUniformMatrix3fv) X(BlendFunc) X(Enablei) X(DepthFunc) X(DepthMask) \
    X(ProgramUniformMatrix4fv) X(Scissor) X(ShaderSource) X(TextureParameterfv) \
    X(TextureBarrier) X(TextureParameteri) X(TextureStorage2D) X(TextureStorage2DMultisample) X(TextureSubImage2D) X(UseProgram) \
    X(VertexArrayAttribBinding) X(VertexArrayAttribFormat) X(VertexArrayElementBuffer) X(VertexArrayVertexBuffer) \
    X(Viewport)
// clang-format on

namespace stairstep::gl {

#define STAIRSTEP_DECLARE(name) extern constinit thread_local decltype(&::gl##name) name;
STAIRSTEP_GL_FUNCTIONS(STAIRSTEP_DECLARE)
#undef STAIRSTEP_DECLARE

using FunctionPointer = void (*)();

/// Fills the calling thread's table through a context's GetProcAddress; the context must be current.
/// Throws FailureError naming the first function that is missing.
void load_functions(const std::function<FunctionPointer(const char*)>& address_of);

/// Throws FailureError if GL has recorded an error since the last call; `during` says what was being done.
/// Reading errors once a frame is enough to find a wrong call, and cheap.
void throw_on_error(const char* during);

}  // namespace stairstep::gl
