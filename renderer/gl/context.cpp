#include "renderer/gl/context.h"

#include <algorithm>
#include <array>

#ifdef __SANITIZE_ADDRESS__
#include <dlfcn.h>
#include <link.h>

#include <vector>
#endif

#include "renderer/gl/functions.h"
#include "renderer/gl/window.h"
#include "stimuli/error.h"

namespace stairstep::gl {
namespace {

constexpr std::array kKinds{ContextKind::osmesa, ContextKind::egl, ContextKind::window};

/// What is current in this thread, of any kind. Each driver's library only knows of its own contexts: one that still
/// believes in a context replaced behind its back makes nothing of being asked for it again.
constinit thread_local Context* current = nullptr;

std::string text_of(GLenum property) {
    const GLubyte* text = GetString(property);
    return text ? reinterpret_cast<const char*>(text) : "";
}

#ifdef __SANITIZE_ADDRESS__
/// Has every library loaded by now stay until the process ends, for the leak sanitizer: drivers are unloaded with their
/// last context, and what only they still point at would count as leaked, by nobody that a report could name.
void keep_libraries() {
    std::vector<std::string> paths;
    dl_iterate_phdr(
        [](dl_phdr_info* library, size_t, void* list) {
            static_cast<std::vector<std::string>*>(list)->emplace_back(library->dlpi_name);
            return 0;
        },
        &paths);
    for (const std::string& path : paths) {
        void* handle = path.empty() ? nullptr : dlopen(path.c_str(), RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
        if (handle) dlclose(handle);
    }
}
#else
void keep_libraries() {}
#endif

}  // namespace

std::string_view name(ContextKind kind) {
    switch (kind) {
        case ContextKind::osmesa: return "osmesa";
        case ContextKind::egl: return "egl";
        case ContextKind::window: return "window";
    }
    return "";
}

ContextKind context_kind_named(const std::string& text) {
    const auto* kind = std::find_if(kKinds.begin(), kKinds.end(), [&](ContextKind k) { return name(k) == text; });
    if (kind == kKinds.end()) {
        throw InputError("--context", "\"" + text + "\" is no kind of context", "use one of osmesa, egl, window");
    }
    return *kind;
}

bool is_software_renderer(std::string_view renderer) {
    constexpr std::array<std::string_view, 5> kNames{"llvmpipe", "softpipe", "swrast", "Software Rasterizer",
                                                     "SwiftShader"};
    return std::any_of(kNames.begin(), kNames.end(),
                       [&](std::string_view known) { return renderer.find(known) != std::string_view::npos; });
}

void Context::make_current() {
    if (current != this) release_any();
    bind();
    current = this;
    load_functions([this](const char* function) { return address_of(function); });
    if (description_.version.empty()) {
        keep_libraries();
        description_.renderer = text_of(GL_RENDERER);
        description_.version = text_of(GL_VERSION);
        description_.is_software = is_software_renderer(description_.renderer);
    }
}

void Context::release_any() {
    if (current) current->release();
}

void Context::release() {
    if (current != this) return;
    current = nullptr;
    unbind();
}

std::unique_ptr<Context> make_context(ContextKind kind, const WindowOptions& window) {
    switch (kind) {
        case ContextKind::osmesa: return make_osmesa_context();
        case ContextKind::egl: return make_egl_context();
        case ContextKind::window: return make_window(window);
    }
    return nullptr;
}

std::string renderer_name() {
    return text_of(GL_RENDERER);
}

}  // namespace stairstep::gl
