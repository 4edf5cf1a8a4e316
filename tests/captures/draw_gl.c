// As draw.c, with OpenGL 4.5 on a surfaceless display of EGL. With an argument, the name of a depth
// format, there is a depth test, and a depth bias.

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 48, HEIGHT = 32 };
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

// What RenderDoc's in-application API 1.4.1 returns; see draw.c.
struct RenderDoc {
  void* before[19];
  void (*start_frame_capture)(void* device, void* window);
  void* is_frame_capturing;
  uint32_t (*end_frame_capture)(void* device, void* window);
};
typedef int (*GetApi)(int version, struct RenderDoc** api);

// The second instance is the mirror image of the first. Only the second clip distance is enabled.
static const char kVertexShader[] =
    "#version 450\n"
    "layout(location = 0) in vec4 position;\n"
    "layout(location = 1) in vec4 values;\n"
    "layout(location = 2) in float distance_to_plane;\n"
    "out vec2 uv; out float in_window; flat out float of_first; flat out int number;\n"
    "out gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[2]; };\n"
    "void main() {\n"
    "  number = gl_InstanceID;\n"
    "  gl_Position = vec4(gl_InstanceID > 0 ? -position.x : position.x, position.yzw);\n"
    "  gl_ClipDistance[0] = -1;\n"
    "  gl_ClipDistance[1] = distance_to_plane;\n"
    "  uv = values.xy; in_window = values.z; of_first = values.w;\n"
    "}\n";
static const char kFragmentShader[] =
    "#version 450\n"
    "/* flat in vec2 uv; */ in vec2 uv; // flat in vec2 uv;\n"
    "noperspective in float in_window; flat in float of_first; flat in int number;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() { color = vec4(uv, in_window, of_first + 0 * number); }\n";

typedef float Vertex[9];  // as in draw.c

static const Vertex kVertices[] = {
    {9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f},  // before the base vertex
    {-0.9f, -0.8f, 0.1f, 1.0f, 0.1f, 1.0f, 0.3f, 10.1f, 1.0f},
    {-0.1f, -0.7f, -0.2f, 1.25f, 0.7f, 2.0f, 0.5f, 11.1f, 1.0f},
    {-0.05f, 0.5f, 0.3f, 0.75f, 0.2f, 3.0f, 0.7f, 12.1f, -0.25f},
    {-0.8f, 1.1f, -0.4f, 1.3f, 0.9f, 4.0f, 0.9f, 14.1f, 1.0f},
};
static const uint32_t kIndices[] = {0, 1, 3, 2, 0xffffffff, 0, 1};

static const struct Draw {
  const char* name;
  GLenum topology, provoking;
  float viewport[6];
  int scissor[4];
  GLenum front, culled;  // GL_NONE: nothing is culled
} kDraws[] = {
    {"fan", GL_TRIANGLE_FAN, GL_LAST_VERTEX_CONVENTION, {2.25f, 1.5f, 43.5f, 28.75f, 0.25f, 0.75f},
     {5, 3, 37, 24}, GL_CCW, GL_NONE},
    {"strip", GL_TRIANGLE_STRIP, GL_FIRST_VERTEX_CONVENTION, {0.0f, 0.0f, 48.0f, 32.0f, 0.0f, 1.0f},
     {0, 0, WIDTH, HEIGHT}, GL_CW, GL_FRONT},
};

static GLenum depth_format = GL_NONE;  // there is no depth buffer

static float pixels[WIDTH * HEIGHT * 4];

static int open_context(void) {
  EGLDisplay display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                           EGL_NONE};
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
  EGLConfig config;
  EGLint count = 0;
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) ||
      !eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
    return 0;
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
  return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
}

static void attach(GLuint program, GLenum stage, const char* source) {
  GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &source, NULL);
  glCompileShader(shader);
  glAttachShader(program, shader);
}

static int make_shared(void) {
  GLuint framebuffer, texture, array, buffers[2], program = glCreateProgram();
  attach(program, GL_VERTEX_SHADER, kVertexShader);
  attach(program, GL_FRAGMENT_SHADER, kFragmentShader);
  glLinkProgram(program);
  glUseProgram(program);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, WIDTH, HEIGHT);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  if (depth_format != GL_NONE) {
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, depth_format, WIDTH, HEIGHT);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffsetClamp(1.5f, -3, 0.03125f);
    glClearDepth(0.875);
  }
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glGenBuffers(2, buffers);
  glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  glBufferData(GL_ARRAY_BUFFER, sizeof kVertices, kVertices, GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof kIndices, kIndices, GL_STATIC_DRAW);
  for (GLuint i = 0; i < 3; ++i) {
    const uintptr_t offset = 4 * i * sizeof(float);
    glVertexAttribPointer(i, i < 2 ? 4 : 1, GL_FLOAT, GL_FALSE, sizeof(Vertex), (void*)offset);
    glEnableVertexAttribArray(i);
  }
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_CLIP_DISTANCE1);
  glEnable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  return glGetError() == GL_NO_ERROR;
}

static void draw(const struct Draw* d) {
  glDisable(GL_SCISSOR_TEST);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);
  (d->culled == GL_NONE ? glDisable : glEnable)(GL_CULL_FACE);
  if (d->culled != GL_NONE) glCullFace(d->culled);
  glFrontFace(d->front);
  glProvokingVertex(d->provoking);
  const float* v = d->viewport;
  glViewportIndexedf(0, v[0], v[1], v[2], v[3]);
  glDepthRange((double)v[4], (double)v[5]);
  glScissor(d->scissor[0], d->scissor[1], d->scissor[2], d->scissor[3]);
  if (d->topology == GL_TRIANGLE_FAN)
    glDrawArraysInstanced(GL_TRIANGLE_FAN, 1, 4, 2);
  else
    glDrawElementsBaseVertex(d->topology, COUNT(kIndices), GL_UNSIGNED_INT, NULL, 1);
  glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_FLOAT, pixels);
}

static void print_floats(const char* name, const float* values, size_t count) {
  printf("\"%s\": [", name);
  for (size_t i = 0; i < count; ++i) printf("%s\"%a\"", i ? ", " : "", (double)values[i]);
  printf("], ");
}

// Takes the depth format of that name; false if there is none.
static int choose_format(const char* name) {
  static const struct { const char* name; GLenum format; } kFormats[] = {
      {"DEPTH_COMPONENT16", GL_DEPTH_COMPONENT16}, {"DEPTH_COMPONENT24", GL_DEPTH_COMPONENT24},
      {"DEPTH24_STENCIL8", GL_DEPTH24_STENCIL8}, {"DEPTH_COMPONENT32F", GL_DEPTH_COMPONENT32F},
      {"DEPTH32F_STENCIL8", GL_DEPTH32F_STENCIL8}};
  for (size_t i = 0; i < COUNT(kFormats); ++i) {
    depth_format = kFormats[i].format;
    if (strcmp(kFormats[i].name, name) == 0) return 1;
  }
  return 0;
}

int main(int count, char** words) {
  if (count > 1 && !choose_format(words[1])) return 1;
  if (!open_context() || !make_shared()) return 1;
  struct RenderDoc* renderdoc = NULL;
  void* library = dlopen("librenderdoc.so", RTLD_NOW | RTLD_NOLOAD);
  GetApi get_api = library ? (GetApi)dlsym(library, "RENDERDOC_GetAPI") : NULL;
  if (get_api && get_api(10401, &renderdoc) != 1) return 1;
  if (renderdoc) renderdoc->start_frame_capture(NULL, NULL);
  printf("{\"width\": %d, \"height\": %d, \"draws\": [", WIDTH, HEIGHT);
  for (size_t i = 0; i < COUNT(kDraws); ++i) {
    const struct Draw* d = &kDraws[i];
    draw(d);
    printf(i > 0 ? ",\n{" : "\n{");
    print_floats("vertices", kVertices[0], sizeof kVertices / sizeof(float));
    print_floats("viewport", d->viewport, 6);
    print_floats("pixels", pixels, COUNT(pixels));
    printf("\"scissor\": [%d, %d, %d, %d], \"name\": \"%s\"}", d->scissor[0], d->scissor[1],
           d->scissor[2], d->scissor[3], d->name);
  }
  printf("]}\n");
  return renderdoc && renderdoc->end_frame_capture(NULL, NULL) != 1;
}
