// Draws a few triangles with Vulkan, without a display, as the frame of a RenderDoc capture if
// RenderDoc has loaded itself. Prints as JSON what it drew: the numbers that it gave to Vulkan, and
// the pixels of each draw, read back from a target of its own in RGBA32F.
//
// capture_test.py compiles it, together with draw.vert and draw.frag as SPIR-V.

#include <dlfcn.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

#include "draw.frag.h"
#include "draw.vert.h"

enum { WIDTH = 48, HEIGHT = 32, TEXELS = WIDTH * HEIGHT, MAX_BYTES = 4096 };

// What RenderDoc's in-application API 1.4.1 returns: function pointers, of which only the
// twentieth and the twenty-second are used here.
struct RenderDoc {
  void* before[19];
  void (*start_frame_capture)(void* device, void* window);
  void* is_frame_capturing;
  uint32_t (*end_frame_capture)(void* device, void* window);
};
enum { RENDERDOC_VERSION = 10401 };

// Position x, y, z, w; u, v, in_window, of_first; distance to the clip plane.
typedef float Vertex[9];

struct Draw {
  const char* name;
  VkPrimitiveTopology topology;
  const Vertex* vertices;
  uint32_t vertex_count;
  const uint16_t* indices;  // none if the vertices are drawn in order
  uint32_t index_count;
  float scale;  // of positions, by the vertex shader
  VkViewport viewport;
  VkRect2D scissor;
  VkCullModeFlags cull;
  VkFrontFace front_face;
  VkBool32 depth_clamp;
};

// The index of vertex 0 comes late, 0xffff ends the first strip, and vertex 3 is not used.
static const Vertex kStrip[] = {
    {-0.9f, -0.8f, 0.1f, 1.0f, 0.1f, 1.0f, 0.3f, 10.1f, 1.0f},
    {-0.7f, 0.9f, 0.2f, 1.25f, 0.7f, 2.0f, 0.5f, 11.1f, 1.0f},
    {0.05f, -0.85f, 0.3f, 0.75f, 0.2f, 3.0f, 0.7f, 12.1f, 1.0f},
    {9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f},
    {0.1f, 0.8f, 0.4f, 1.1f, 0.9f, 4.0f, 0.9f, 14.1f, 1.0f},
    {0.3f, -0.7f, 0.5f, 1.0f, 0.4f, 5.0f, 1.1f, 15.1f, 1.0f},
    {0.35f, 0.75f, 0.6f, 1.0f, 0.6f, 6.0f, 1.3f, 16.1f, -0.5f},
    {0.95f, -0.1f, 0.7f, 1.5f, 0.8f, 7.0f, 1.5f, 17.1f, 0.5f},
};
static const uint16_t kStripIndices[] = {1, 0, 4, 2, 0xffff, 5, 6, 7};

// The first is behind the eye, the second nearer than the near plane, which clamping ignores.
static const Vertex kBehind[] = {
    {0.3f, -0.6f, 0.1f, -0.4f, 0.1f, -3.0f, 1.0e-3f, 0.7f, 1.0f},
    {-0.9f, 0.7f, -0.1f, 0.9f, 0.3f, 5.0f, 77.7f, 0.8f, 1.0f},
    {0.8f, 0.6f, 0.4f, 1.3f, 0.6f, 1.0f / 3.0f, -0.1f, 0.9f, 1.0f},
    // Turns the other way, and is culled.
    {-0.5f, -0.5f, 0.5f, 1.0f, 0.0f, 0.0f, 0.0f, 0.1f, 1.0f},
    {-0.5f, 0.5f, 0.5f, 1.0f, 0.0f, 0.0f, 0.0f, 0.1f, 1.0f},
    {0.5f, 0.5f, 0.5f, 1.0f, 0.0f, 0.0f, 0.0f, 0.1f, 1.0f},
};

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const struct Draw kDraws[] = {
    {"strip", VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, kStrip, COUNT(kStrip), kStripIndices,
     COUNT(kStripIndices), 0.5f, {2.25f, 1.5f, 43.5f, 28.75f, 0.25f, 0.75f},
     {{5, 3}, {37, 24}}, VK_CULL_MODE_NONE, VK_FRONT_FACE_CLOCKWISE, VK_FALSE},
    {"behind", VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, kBehind, COUNT(kBehind), NULL, 0,
     1.0f, {0.0f, 31.5f, 48.0f, -31.5f, 0.0f, 1.0f},
     {{0, 0}, {WIDTH, HEIGHT}}, VK_CULL_MODE_BACK_BIT, VK_FRONT_FACE_COUNTER_CLOCKWISE, VK_TRUE},
    {"lines", VK_PRIMITIVE_TOPOLOGY_LINE_LIST, kStrip, 2, NULL, 0,
     1.0f, {0.0f, 0.0f, 48.0f, 32.0f, 0.0f, 1.0f},
     {{0, 0}, {WIDTH, HEIGHT}}, VK_CULL_MODE_NONE, VK_FRONT_FACE_CLOCKWISE, VK_FALSE},
};

static VkPhysicalDevice physical;
static VkDevice device;

static void check(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  fprintf(stderr, "draw: %s: VkResult %d\n", what, (int)result);
  exit(1);
}
#define CHECK(call) check(call, #call)

static VkInstance open_device(void) {
  const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                         .apiVersion = VK_API_VERSION_1_1};
  VkInstance instance;
  CHECK(vkCreateInstance(&(VkInstanceCreateInfo){.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                                 .pApplicationInfo = &application},
                         NULL, &instance));
  uint32_t one = 1;
  const VkResult found = vkEnumeratePhysicalDevices(instance, &one, &physical);
  if (found != VK_INCOMPLETE) CHECK(found);
  const float priority = 1;
  const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                         .queueCount = 1, .pQueuePriorities = &priority};
  const VkPhysicalDeviceFeatures features = {.depthClamp = VK_TRUE, .shaderClipDistance = VK_TRUE};
  CHECK(vkCreateDevice(physical,
                       &(VkDeviceCreateInfo){.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                             .queueCreateInfoCount = 1,
                                             .pQueueCreateInfos = &queue,
                                             .pEnabledFeatures = &features},
                       NULL, &device));
  return instance;
}

static VkDeviceMemory allocate(VkMemoryRequirements needs, VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties all;
  vkGetPhysicalDeviceMemoryProperties(physical, &all);
  uint32_t type = 0;
  while ((needs.memoryTypeBits >> type & 1) == 0 ||
         (all.memoryTypes[type].propertyFlags & flags) != flags)
    ++type;
  VkDeviceMemory memory;
  CHECK(vkAllocateMemory(device,
                         &(VkMemoryAllocateInfo){.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                                 .allocationSize = needs.size,
                                                 .memoryTypeIndex = type},
                         NULL, &memory));
  return memory;
}

static VkBuffer make_buffer(VkDeviceSize size, VkBufferUsageFlags usage, void** mapped) {
  VkBuffer buffer;
  CHECK(vkCreateBuffer(device,
                       &(VkBufferCreateInfo){.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                             .size = size, .usage = usage},
                       NULL, &buffer));
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, buffer, &needs);
  VkDeviceMemory memory = allocate(
      needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  CHECK(vkBindBufferMemory(device, buffer, memory, 0));
  CHECK(vkMapMemory(device, memory, 0, size, 0, mapped));
  return buffer;
}

struct Target {
  VkImage image;
  VkRenderPass pass;
  VkFramebuffer framebuffer;
};

static struct Target make_target(void) {
  struct Target t;
  const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
  CHECK(vkCreateImage(device,
                      &(VkImageCreateInfo){.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                           .imageType = VK_IMAGE_TYPE_2D,
                                           .format = format,
                                           .extent = {WIDTH, HEIGHT, 1},
                                           .mipLevels = 1, .arrayLayers = 1,
                                           .samples = VK_SAMPLE_COUNT_1_BIT,
                                           .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
                      NULL, &t.image));
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, t.image, &needs);
  CHECK(vkBindImageMemory(device, t.image, allocate(needs, 0), 0));
  VkImageView view;
  CHECK(vkCreateImageView(
      device,
      &(VkImageViewCreateInfo){.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                               .image = t.image, .viewType = VK_IMAGE_VIEW_TYPE_2D,
                               .format = format,
                               .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}},
      NULL, &view));
  const VkAttachmentDescription color = {.format = format, .samples = VK_SAMPLE_COUNT_1_BIT,
                                         .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                         .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                         .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
  const VkAttachmentReference first = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkSubpassDescription subpass = {.colorAttachmentCount = 1, .pColorAttachments = &first};
  const VkSubpassDependency copied_after = {
      0, VK_SUBPASS_EXTERNAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
      VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
      VK_ACCESS_TRANSFER_READ_BIT, 0};
  CHECK(vkCreateRenderPass(
      device,
      &(VkRenderPassCreateInfo){.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                .attachmentCount = 1, .pAttachments = &color,
                                .subpassCount = 1, .pSubpasses = &subpass,
                                .dependencyCount = 1, .pDependencies = &copied_after},
      NULL, &t.pass));
  CHECK(vkCreateFramebuffer(
      device,
      &(VkFramebufferCreateInfo){.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                 .renderPass = t.pass,
                                 .attachmentCount = 1, .pAttachments = &view,
                                 .width = WIDTH, .height = HEIGHT, .layers = 1},
      NULL, &t.framebuffer));
  return t;
}

static VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits of, const uint32_t* code,
                                             size_t bytes) {
  VkPipelineShaderStageCreateInfo stage = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, .stage = of, .pName = "main"};
  CHECK(vkCreateShaderModule(
      device,
      &(VkShaderModuleCreateInfo){.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                  .codeSize = bytes, .pCode = code},
      NULL, &stage.module));
  return stage;
}

static VkPipeline make_pipeline(const struct Draw* d, VkRenderPass pass, VkPipelineLayout layout) {
  const VkPipelineShaderStageCreateInfo stages[] = {
      stage(VK_SHADER_STAGE_VERTEX_BIT, vertex_code, sizeof vertex_code),
      stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment_code, sizeof fragment_code)};
  const VkVertexInputBindingDescription binding = {0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
  const VkVertexInputAttributeDescription inputs[] = {
      {0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0},
      {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 4 * sizeof(float)},
      {2, 0, VK_FORMAT_R32_SFLOAT, 8 * sizeof(float)}};
  const VkPipelineVertexInputStateCreateInfo vertices = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
      .vertexBindingDescriptionCount = 1, .pVertexBindingDescriptions = &binding,
      .vertexAttributeDescriptionCount = COUNT(inputs), .pVertexAttributeDescriptions = inputs};
  const VkPipelineInputAssemblyStateCreateInfo assembly = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
      .topology = d->topology,
      .primitiveRestartEnable = d->topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP};
  const VkPipelineViewportStateCreateInfo viewport = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
      .viewportCount = 1, .pViewports = &d->viewport,
      .scissorCount = 1, .pScissors = &d->scissor};
  const VkPipelineRasterizationStateCreateInfo rasterization = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
      .depthClampEnable = d->depth_clamp, .cullMode = d->cull, .frontFace = d->front_face,
      .lineWidth = 1};
  const VkPipelineMultisampleStateCreateInfo multisample = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
      .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
  const VkPipelineColorBlendAttachmentState written = {.colorWriteMask = 15};
  const VkPipelineColorBlendStateCreateInfo blend = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
      .attachmentCount = 1, .pAttachments = &written};
  VkPipeline pipeline;
  CHECK(vkCreateGraphicsPipelines(
      device, VK_NULL_HANDLE, 1,
      &(VkGraphicsPipelineCreateInfo){.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                      .stageCount = COUNT(stages), .pStages = stages,
                                      .pVertexInputState = &vertices,
                                      .pInputAssemblyState = &assembly,
                                      .pViewportState = &viewport,
                                      .pRasterizationState = &rasterization,
                                      .pMultisampleState = &multisample,
                                      .pColorBlendState = &blend,
                                      .layout = layout, .renderPass = pass},
      NULL, &pipeline));
  return pipeline;
}

// What all draws share.
struct Shared {
  VkQueue queue;
  VkCommandBuffer commands;
  VkPipelineLayout layout;
  struct Target target;
  VkBuffer vertex_buffer, index_buffer, pixel_buffer;
  void *vertices, *indices;
  float* pixels;  // [texel][4]
};

static struct Shared make_shared(void) {
  struct Shared s;
  vkGetDeviceQueue(device, 0, 0, &s.queue);
  VkCommandPool pool;
  CHECK(vkCreateCommandPool(
      device,
      &(VkCommandPoolCreateInfo){.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                 .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT},
      NULL, &pool));
  CHECK(vkAllocateCommandBuffers(
      device,
      &(VkCommandBufferAllocateInfo){.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                     .commandPool = pool, .commandBufferCount = 1},
      &s.commands));
  const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT, 0, 4 * sizeof(float)};
  CHECK(vkCreatePipelineLayout(
      device,
      &(VkPipelineLayoutCreateInfo){.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                    .pushConstantRangeCount = 1, .pPushConstantRanges = &push},
      NULL, &s.layout));
  s.target = make_target();
  s.vertex_buffer = make_buffer(MAX_BYTES, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &s.vertices);
  s.index_buffer = make_buffer(MAX_BYTES, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, &s.indices);
  void* pixels;
  s.pixel_buffer =
      make_buffer(TEXELS * 4 * sizeof(float), VK_BUFFER_USAGE_TRANSFER_DST_BIT, &pixels);
  s.pixels = pixels;
  return s;
}

static void record(const struct Shared* s, const struct Draw* d) {
  VkCommandBuffer c = s->commands;
  CHECK(vkBeginCommandBuffer(c, &(VkCommandBufferBeginInfo){
                                    .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO}));
  const VkClearValue zeros = {0};
  vkCmdBeginRenderPass(c,
                       &(VkRenderPassBeginInfo){.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                                .renderPass = s->target.pass,
                                                .framebuffer = s->target.framebuffer,
                                                .renderArea = {{0, 0}, {WIDTH, HEIGHT}},
                                                .clearValueCount = 1, .pClearValues = &zeros},
                       VK_SUBPASS_CONTENTS_INLINE);
  vkCmdBindPipeline(c, VK_PIPELINE_BIND_POINT_GRAPHICS,
                    make_pipeline(d, s->target.pass, s->layout));
  const float scale[4] = {d->scale, d->scale, d->scale, d->scale};
  vkCmdPushConstants(c, s->layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof scale, scale);
  const VkDeviceSize at_begin = 0;
  vkCmdBindVertexBuffers(c, 0, 1, &s->vertex_buffer, &at_begin);
  if (d->indices) {
    vkCmdBindIndexBuffer(c, s->index_buffer, 0, VK_INDEX_TYPE_UINT16);
    vkCmdDrawIndexed(c, d->index_count, 1, 0, 0, 0);
  } else {
    vkCmdDraw(c, d->vertex_count, 1, 0, 0);
  }
  vkCmdEndRenderPass(c);
  const VkBufferImageCopy whole = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {WIDTH, HEIGHT, 1}};
  vkCmdCopyImageToBuffer(c, s->target.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                         s->pixel_buffer, 1, &whole);
  CHECK(vkEndCommandBuffer(c));
}

static void draw(const struct Shared* s, const struct Draw* d) {
  memcpy(s->vertices, d->vertices, d->vertex_count * sizeof(Vertex));
  if (d->indices) memcpy(s->indices, d->indices, d->index_count * sizeof(uint16_t));
  record(s, d);
  CHECK(vkQueueSubmit(s->queue, 1,
                      &(VkSubmitInfo){.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                      .commandBufferCount = 1, .pCommandBuffers = &s->commands},
                      VK_NULL_HANDLE));
  CHECK(vkQueueWaitIdle(s->queue));
}

static void print_floats(const char* name, const float* values, uint32_t count) {
  printf("\"%s\": [", name);
  for (uint32_t i = 0; i < count; ++i) printf("%s\"%a\"", i ? ", " : "", (double)values[i]);
  printf("]");
}

static void print_drawn(const struct Draw* d, const float* pixels) {
  printf("{\"name\": \"%s\", ", d->name);
  print_floats("vertices", &d->vertices[0][0], d->vertex_count * COUNT(d->vertices[0]));
  printf(", \"scale\": %g, ", (double)d->scale);
  const VkViewport v = d->viewport;
  print_floats("viewport", (const float[]){v.x, v.y, v.width, v.height, v.minDepth, v.maxDepth}, 6);
  printf(", \"scissor\": [%d, %d, %" PRIu32 ", %" PRIu32 "], ", d->scissor.offset.x,
         d->scissor.offset.y, d->scissor.extent.width, d->scissor.extent.height);
  print_floats("pixels", pixels, 4 * TEXELS);
  printf("}");
}

int main(void) {
  VkInstance instance = open_device();
  const struct Shared shared = make_shared();
  // RenderDoc is asked for only if it is there already: it captures nothing if it is loaded late.
  struct RenderDoc* renderdoc = NULL;
  void* library = dlopen("librenderdoc.so", RTLD_NOW | RTLD_NOLOAD);
  if (library) {
    int (*get_api)(int, void**) = (int (*)(int, void**))dlsym(library, "RENDERDOC_GetAPI");
    if (get_api(RENDERDOC_VERSION, (void**)&renderdoc) != 1) return 1;
  }
  // The first word of an instance tells RenderDoc which device it is.
  void* captured = *(void**)instance;
  if (renderdoc) renderdoc->start_frame_capture(captured, NULL);
  printf("{\"width\": %d, \"height\": %d, \"draws\": [\n", WIDTH, HEIGHT);
  for (size_t i = 0; i < COUNT(kDraws); ++i) {
    draw(&shared, &kDraws[i]);
    if (i > 0) printf(",\n");
    print_drawn(&kDraws[i], shared.pixels);
  }
  printf("]}\n");
  if (renderdoc && renderdoc->end_frame_capture(captured, NULL) != 1) return 1;
  return 0;
}
