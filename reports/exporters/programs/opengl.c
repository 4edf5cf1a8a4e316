static void check_gl(const char *what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  fprintf(stderr, "glGetError() is 0x%x: ", error);
  give_up(what);
}

/* Opens a context without a window: Mesa's surfaceless platform, or the default display. */
static void open_context(void) {
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, NULL, NULL);
  if (!eglInitialize(display, NULL, NULL)) {
    display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (!eglInitialize(display, NULL, NULL)) give_up("no EGL display");
  }
  eglBindAPI(EGL_OPENGL_API);
  const EGLint version[][5] = {
      {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE},
      {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE}};
  EGLContext context = EGL_NO_CONTEXT;
  for (int i = 0; i < 2 && context == EGL_NO_CONTEXT; ++i) {
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version[i]);
  }
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    give_up("no OpenGL context");
  }
  GLint subpixel_bits = 0;
  glGetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
  check_grid(subpixel_bits);
  printf("%s, OpenGL %s\n", (const char *)glGetString(GL_RENDERER),
         (const char *)glGetString(GL_VERSION));
}

static void compile(GLuint program, GLenum stage, const char *text) {
  const GLuint shader = glCreateShader(stage);
  GLint is_compiled = 0;
  glShaderSource(shader, 1, &text, NULL);
  glCompileShader(shader);
  glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
  if (!is_compiled) {
    char log[2000];
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    give_up(log);
  }
  glAttachShader(program, shader);
}

static void use_program(void) {
  const GLuint program = glCreateProgram();
  GLint is_linked = 0;
  compile(program, GL_VERTEX_SHADER, vertex_shader);
  compile(program, GL_FRAGMENT_SHADER, fragment_shader);
  for (GLuint i = 0; i < VECTORS; ++i) glBindAttribLocation(program, i, inputs[i]);
  glLinkProgram(program);
  glGetProgramiv(program, GL_LINK_STATUS, &is_linked);
  if (!is_linked) give_up("the shaders do not link");
  glUseProgram(program);
}

static void make_target(void) {
  GLuint framebuffer, target;
  glGenFramebuffers(1, &framebuffer);
  glGenRenderbuffers(1, &target);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glBindRenderbuffer(GL_RENDERBUFFER, target);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, SAMPLES > 1 ? SAMPLES : 0, GL_RGBA8, WIDTH,
                                   HEIGHT);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    give_up("the target cannot be drawn to");
  }
  GLint samples_drawn = 0;
  glGetIntegerv(GL_SAMPLES, &samples_drawn);
  if (SAMPLES > 1 && samples_drawn != SAMPLES) give_up("the target has another number of samples");
  for (GLuint i = 0; SAMPLES > 1 && i < SAMPLES; ++i) {
    GLfloat at[2];
    glGetMultisamplefv(GL_SAMPLE_POSITION, i, at);
    if (at[0] * 16 != positions[i][0] || at[1] * 16 != positions[i][1]) {
      give_up("samples are not at the standard positions");
    }
  }
}

static void set_state(void) {
#if IS_VULKAN
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
#else
  glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
#endif
  glViewportIndexedf(0, viewport[0], viewport[1], viewport[2], viewport[3]);
  glDepthRange(viewport[4], viewport[5]);
  if (HAS_SCISSOR) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(scissor[0], scissor[1], scissor[2], scissor[3]);
  }
  if (CULLS_BACK || CULLS_FRONT) glEnable(GL_CULL_FACE);
  glCullFace(CULLS_FRONT ? GL_FRONT : GL_BACK);
  /* Vulkan's y points down, so that this framebuffer is displayed the other way up. */
  glFrontFace(IS_FRONT_CCW != IS_VULKAN ? GL_CCW : GL_CW);
  if (CLAMPS_DEPTH) glEnable(GL_DEPTH_CLAMP);
  for (int i = 0; i < CLIP_DISTANCES; ++i) glEnable(GL_CLIP_DISTANCE0 + (GLenum)i);
  check_gl("the state is refused");
}

static void hand_over_vertices(void) {
  GLuint array, buffer;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, sizeof vertices, vertices, GL_STATIC_DRAW);
  for (GLuint i = 0; i < VECTORS; ++i) {
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, VECTORS * 16, (const void *)(i * (size_t)16));
  }
}

int main(void) {
  open_context();
  make_target();
  set_state();
  use_program();
  hand_over_vertices();
  static uint32_t records[RECORDS];
  GLuint buffer;
  int faults = 0;
  glGenBuffers(1, &buffer);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
  for (int triangle = FIRST_TRIANGLE; triangle < END_TRIANGLE; ++triangle) {
    memset(records, 0, sizeof records);
    glBufferData(GL_SHADER_STORAGE_BUFFER, sizeof records, records, GL_DYNAMIC_READ);
    glDrawArrays(GL_TRIANGLES, 3 * triangle, 3);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof records, records);
    check_gl("drawing failed");
    faults += check(triangle, records);
  }
  printf(faults == 0 ? "all right\n" : "%d faults\n", faults);
  return faults != 0;
}
