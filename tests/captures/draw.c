// Draws a few triangles with Vulkan 1.3, without a display, as the frame of a RenderDoc capture if
// RenderDoc is loaded. Prints as JSON what it gave to Vulkan, and the pixels of each draw in RGBA32F,
// read back. captures_test.py compiles it, and its shaders to headers. With an argument, the name of a
// format, depths are stored in it, and the draw with a depth test has a depth bias.

#include <dlfcn.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

#include "draw.vert.h"
#include "noperspective.frag.h"
#include "smooth.frag.h"

enum { WIDTH = 48, HEIGHT = 32, PIXEL_BYTES = WIDTH * HEIGHT * 16, MAX_BYTES = 4096 };
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define CHECK(call) check(call, #call)
#define MAKE(kind, info, result) CHECK(vkCreate##kind(device, info, NULL, result))

// What RenderDoc's in-application API 1.4.1 returns: pointers to functions, the twentieth and the
// twenty-second of which are used here.
struct RenderDoc {
  void* before[19];
  void (*start_frame_capture)(void* device, void* window);
  void* is_frame_capturing;
  uint32_t (*end_frame_capture)(void* device, void* window);
};
typedef int (*GetApi)(int version, struct RenderDoc** api);

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
  const uint32_t* fragment_code;
  size_t fragment_bytes;
  VkViewport viewport;
  VkRect2D scissor;
  VkCullModeFlags cull;
  VkFrontFace front_face;
  VkBool32 depth_clamp, depth_test;  // less; otherwise depths are neither tested nor written
};

// 0xffff ends the first strip; vertex 3 is not used.
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

// Of the first triangle, a vertex is behind the eye and one before the near plane. The second cuts
// through it. The third turns the other way, and is culled.
static const Vertex kBehind[] = {
    {0.3f, -0.6f, 0.1f, -0.4f, 0.1f, -3.0f, 1.0e-3f, 0.7f, 1.0f},
    {-0.9f, 0.7f, -0.1f, 0.9f, 0.3f, 5.0f, 77.7f, 0.8f, 1.0f},
    {0.8f, 0.6f, 0.4f, 1.3f, 0.6f, 1.0f / 3.0f, -0.1f, 0.9f, 1.0f},
    {-0.9f, 0.2f, 0.4f, 0.9f, 0.2f, 1.5f, 3.0f, 0.6f, 1.0f},
    {-0.6f, 0.9f, 0.1f, 1.0f, 0.4f, 3.5f, 5.0f, 0.4f, 1.0f},
    {0.7f, 0.5f, 0.2f, 0.8f, 0.9f, 2.5f, 4.0f, 0.5f, 1.0f},
    {-0.5f, -0.5f, 0.5f, 1.0f, 0.0f, 0.0f, 0.0f, 0.1f, 1.0f},
    {-0.5f, 0.5f, 0.5f, 1.0f, 0.0f, 0.0f, 0.0f, 0.1f, 1.0f},
    {0.5f, 0.5f, 0.5f, 1.0f, 0.0f, 0.0f, 0.0f, 0.1f, 1.0f},
};
static const float kDepthClear = 0.875f;

static const struct Draw kDraws[] = {
    {"strip", VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, kStrip, COUNT(kStrip), kStripIndices,
     COUNT(kStripIndices), 0.5f, noperspective_code, sizeof noperspective_code,
     {2.25f, 1.5f, 43.5f, 28.75f, 0.25f, 0.75f}, {{5, 3}, {37, 24}},
     VK_CULL_MODE_NONE, VK_FRONT_FACE_COUNTER_CLOCKWISE, VK_FALSE, VK_FALSE},
    {"behind", VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, kBehind, COUNT(kBehind), NULL,
     0, 1.0f, smooth_code, sizeof smooth_code,
     {0.0f, 32.0f, 48.0f, -32.0f, 0.0f, 1.0f}, {{0, 0}, {WIDTH, HEIGHT}},
     VK_CULL_MODE_BACK_BIT, VK_FRONT_FACE_CLOCKWISE, VK_TRUE, VK_TRUE},
    {"lines", VK_PRIMITIVE_TOPOLOGY_LINE_LIST, kStrip, 2, NULL,
     0, 1.0f, smooth_code, sizeof smooth_code,
     {0.0f, 0.0f, 48.0f, 32.0f, 0.0f, 1.0f}, {{0, 0}, {WIDTH, HEIGHT}},
     VK_CULL_MODE_NONE, VK_FRONT_FACE_CLOCKWISE, VK_FALSE, VK_FALSE},
};

static VkInstance instance;
static VkPhysicalDevice physical;
static VkDevice device;
static VkQueue queue;
static VkCommandBuffer commands;
static VkPipelineLayout layout;
static VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
static VkImageAspectFlags depth_aspects = VK_IMAGE_ASPECT_DEPTH_BIT;
static VkBool32 is_biased;
static VkImage color, depth;
static VkImageView color_view, depth_view;
static VkBuffer vertex_buffer, index_buffer, pixel_buffer;
static void *vertices, *indices, *pixels;

static void check(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  fprintf(stderr, "draw: %.60s: VkResult %d\n", what, (int)result);
  exit(1);
}

static void open_device(void) {
  const VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                         .apiVersion = VK_API_VERSION_1_3};
  CHECK(vkCreateInstance(&(VkInstanceCreateInfo){VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                                 .pApplicationInfo = &application},
                         NULL, &instance));
  CHECK(vkEnumeratePhysicalDevices(instance, &(uint32_t){1}, &physical));
  const VkPhysicalDeviceVulkan13Features dynamic = {
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, .dynamicRendering = VK_TRUE};
  const VkDeviceQueueCreateInfo one = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                       .queueCount = 1, .pQueuePriorities = &(float){1}};
  CHECK(vkCreateDevice(physical,
                       &(VkDeviceCreateInfo){VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &dynamic,
                                             .queueCreateInfoCount = 1, .pQueueCreateInfos = &one,
                                             .pEnabledFeatures = &(VkPhysicalDeviceFeatures){
                                                 .depthClamp = 1, .depthBiasClamp = 1,
                                                 .shaderClipDistance = 1}},
                       NULL, &device));
  vkGetDeviceQueue(device, 0, 0, &queue);
}

// Memory of the first type that fits and that the processor sees; images here fit it as well.
static VkDeviceMemory allocate(VkMemoryRequirements needs) {
  const VkMemoryPropertyFlags wanted =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  VkPhysicalDeviceMemoryProperties all;
  vkGetPhysicalDeviceMemoryProperties(physical, &all);
  uint32_t type = 0;
  while (!(needs.memoryTypeBits >> type & 1) ||
         (all.memoryTypes[type].propertyFlags & wanted) != wanted)
    ++type;
  VkDeviceMemory memory;
  CHECK(vkAllocateMemory(device,
                         &(VkMemoryAllocateInfo){VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                                 .allocationSize = needs.size,
                                                 .memoryTypeIndex = type},
                         NULL, &memory));
  return memory;
}

static void make_buffer(VkDeviceSize size, VkBufferUsageFlags usage, VkBuffer* buffer, void** at) {
  MAKE(Buffer, (&(VkBufferCreateInfo){VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size,
                                      .usage = usage}), buffer);
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, *buffer, &needs);
  VkDeviceMemory memory = allocate(needs);
  CHECK(vkBindBufferMemory(device, *buffer, memory, 0));
  CHECK(vkMapMemory(device, memory, 0, size, 0, at));
}

static VkImageView make_image(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect,
                              VkImage* image) {
  MAKE(Image, (&(VkImageCreateInfo){VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = VK_IMAGE_TYPE_2D, .format = format,
                                    .extent = {WIDTH, HEIGHT, 1}, .mipLevels = 1, .arrayLayers = 1,
                                    .samples = VK_SAMPLE_COUNT_1_BIT, .usage = usage}), image);
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, *image, &needs);
  CHECK(vkBindImageMemory(device, *image, allocate(needs), 0));
  VkImageView view;
  MAKE(ImageView, (&(VkImageViewCreateInfo){VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                            .image = *image, .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                            .format = format,
                                            .subresourceRange = {aspect, 0, 1, 0, 1}}), &view);
  return view;
}

// Makes all that the draws share.
static void make_shared(void) {
  VkCommandPool pool;
  MAKE(CommandPool, (&(VkCommandPoolCreateInfo){
           VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
           .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT}), &pool);
  CHECK(vkAllocateCommandBuffers(
      device, &(VkCommandBufferAllocateInfo){VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = pool, .commandBufferCount = 1},
      &commands));
  const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(float)};
  MAKE(PipelineLayout, (&(VkPipelineLayoutCreateInfo){
           VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .pushConstantRangeCount = 1,
           .pPushConstantRanges = &push}), &layout);
  color_view = make_image(VK_FORMAT_R32G32B32A32_SFLOAT,
                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                          VK_IMAGE_ASPECT_COLOR_BIT, &color);
  depth_view = make_image(depth_format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                          depth_aspects, &depth);
  make_buffer(MAX_BYTES, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &vertex_buffer, &vertices);
  make_buffer(MAX_BYTES, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, &index_buffer, &indices);
  make_buffer(PIXEL_BYTES, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &pixel_buffer, &pixels);
}

static VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits of, const uint32_t* code,
                                             size_t bytes) {
  VkPipelineShaderStageCreateInfo stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                           .stage = of, .pName = "main"};
  MAKE(ShaderModule, (&(VkShaderModuleCreateInfo){VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                                  .codeSize = bytes, .pCode = code}),
       &stage.module);
  return stage;
}

static VkPipeline make_pipeline(const struct Draw* d) {
  const VkPipelineShaderStageCreateInfo stages[] = {
      stage(VK_SHADER_STAGE_VERTEX_BIT, vertex_code, sizeof vertex_code),
      stage(VK_SHADER_STAGE_FRAGMENT_BIT, d->fragment_code, d->fragment_bytes)};
  const VkVertexInputBindingDescription binding = {0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
  const VkVertexInputAttributeDescription inputs[] = {
      {0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0},
      {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 4 * sizeof(float)},
      {2, 0, VK_FORMAT_R32_SFLOAT, 8 * sizeof(float)}};
  const VkPipelineVertexInputStateCreateInfo input = {
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
      .vertexBindingDescriptionCount = 1, .pVertexBindingDescriptions = &binding,
      .vertexAttributeDescriptionCount = COUNT(inputs), .pVertexAttributeDescriptions = inputs};
  const VkPipelineInputAssemblyStateCreateInfo assembly = {
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, .topology = d->topology,
      .primitiveRestartEnable = d->topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP};
  const VkPipelineViewportStateCreateInfo viewport = {
      VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1,
      .pViewports = &d->viewport, .scissorCount = 1, .pScissors = &d->scissor};
  const VkPipelineRasterizationStateCreateInfo rasterization = {
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .cullMode = d->cull,
      .depthClampEnable = d->depth_clamp, .frontFace = d->front_face, .lineWidth = 1,
      .depthBiasEnable = is_biased && d->depth_test, .depthBiasConstantFactor = -3,
      .depthBiasSlopeFactor = 1.5f, .depthBiasClamp = 0.03125f};
  const VkPipelineMultisampleStateCreateInfo multisample = {
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
      .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
  const VkPipelineDepthStencilStateCreateInfo depth_test = {
      VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
      .depthTestEnable = d->depth_test, .depthWriteEnable = VK_TRUE,
      .depthCompareOp = VK_COMPARE_OP_LESS};
  const VkPipelineColorBlendAttachmentState written = {.colorWriteMask = 15};
  const VkPipelineColorBlendStateCreateInfo blend = {
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO, .attachmentCount = 1,
      .pAttachments = &written};
  const VkPipelineRenderingCreateInfo rendering = {
      VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO, .colorAttachmentCount = 1,
      .pColorAttachmentFormats = &(VkFormat){VK_FORMAT_R32G32B32A32_SFLOAT},
      .depthAttachmentFormat = depth_format};
  VkPipeline pipeline;
  CHECK(vkCreateGraphicsPipelines(
      device, VK_NULL_HANDLE, 1,
      &(VkGraphicsPipelineCreateInfo){
          VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering, .stageCount = 2,
          .pStages = stages, .pVertexInputState = &input, .pInputAssemblyState = &assembly,
          .pViewportState = &viewport, .pRasterizationState = &rasterization,
          .pMultisampleState = &multisample, .pDepthStencilState = &depth_test,
          .pColorBlendState = &blend, .layout = layout},
      NULL, &pipeline));
  return pipeline;
}

static void barrier(VkImage image, VkImageAspectFlags aspect, VkImageLayout before) {
  const VkImageMemoryBarrier all = {
      VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
      .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
      .oldLayout = before, .newLayout = VK_IMAGE_LAYOUT_GENERAL, .image = image,
      .subresourceRange = {aspect, 0, 1, 0, 1}};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &all);
}

static VkRenderingAttachmentInfo cleared(VkImageView view, VkClearValue to) {
  return (VkRenderingAttachmentInfo){
      VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO, .imageView = view,
      .imageLayout = VK_IMAGE_LAYOUT_GENERAL, .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
      .storeOp = VK_ATTACHMENT_STORE_OP_STORE, .clearValue = to};
}

static void record(const struct Draw* d) {
  const VkRenderingAttachmentInfo colors = cleared(color_view, (VkClearValue){0});
  const VkRenderingAttachmentInfo depths =
      cleared(depth_view, (VkClearValue){.depthStencil = {kDepthClear, 0}});
  barrier(color, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED);
  barrier(depth, depth_aspects, VK_IMAGE_LAYOUT_UNDEFINED);
  vkCmdBeginRendering(commands, &(VkRenderingInfo){
                                    VK_STRUCTURE_TYPE_RENDERING_INFO, .layerCount = 1,
                                    .renderArea = {{0, 0}, {WIDTH, HEIGHT}},
                                    .colorAttachmentCount = 1, .pColorAttachments = &colors,
                                    .pDepthAttachment = &depths});
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, make_pipeline(d));
  vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof d->scale, &d->scale);
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &(VkDeviceSize){0});
  if (d->indices) {
    vkCmdBindIndexBuffer(commands, index_buffer, 0, VK_INDEX_TYPE_UINT16);
    vkCmdDrawIndexed(commands, d->index_count, 1, 0, 0, 0);
  } else {
    vkCmdDraw(commands, d->vertex_count, 1, 0, 0);
  }
  vkCmdEndRendering(commands);
  barrier(color, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_GENERAL);
  vkCmdCopyImageToBuffer(commands, color, VK_IMAGE_LAYOUT_GENERAL, pixel_buffer, 1,
                         &(VkBufferImageCopy){
                             .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                             .imageExtent = {WIDTH, HEIGHT, 1}});
}

// Draws, and waits until `pixels` has the picture.
static void draw(const struct Draw* d) {
  memcpy(vertices, d->vertices, d->vertex_count * sizeof(Vertex));
  if (d->indices) memcpy(indices, d->indices, d->index_count * sizeof(uint16_t));
  CHECK(vkBeginCommandBuffer(
      commands, &(VkCommandBufferBeginInfo){.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO}));
  record(d);
  CHECK(vkEndCommandBuffer(commands));
  CHECK(vkQueueSubmit(queue, 1, &(VkSubmitInfo){VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                                .commandBufferCount = 1,
                                                .pCommandBuffers = &commands},
                      VK_NULL_HANDLE));
  CHECK(vkQueueWaitIdle(queue));
}

static void print_floats(const char* name, const float* values, size_t count) {
  printf("\"%s\": [", name);
  for (size_t i = 0; i < count; ++i) printf("%s\"%a\"", i ? ", " : "", (double)values[i]);
  printf("], ");
}

static void print_drawn(const struct Draw* d) {
  const VkViewport v = d->viewport;
  printf("{");
  print_floats("vertices", d->vertices[0], d->vertex_count * COUNT(d->vertices[0]));
  print_floats("viewport", (float[]){v.x, v.y, v.width, v.height, v.minDepth, v.maxDepth}, 6);
  print_floats("pixels", pixels, PIXEL_BYTES / sizeof(float));
  printf("\"scissor\": [%d, %d, %" PRIu32 ", %" PRIu32 "], \"name\": \"%s\"}", d->scissor.offset.x,
         d->scissor.offset.y, d->scissor.extent.width, d->scissor.extent.height, d->name);
}

// Takes the depth format of that name; false if there is none.
static int choose_format(const char* name) {
  static const struct { const char* name; VkFormat format; } kFormats[] = {
      {"D16_UNORM", VK_FORMAT_D16_UNORM}, {"X8_D24_UNORM", VK_FORMAT_X8_D24_UNORM_PACK32},
      {"D24_UNORM_S8", VK_FORMAT_D24_UNORM_S8_UINT}, {"D32_SFLOAT", VK_FORMAT_D32_SFLOAT},
      {"D32_SFLOAT_S8", VK_FORMAT_D32_SFLOAT_S8_UINT}};
  is_biased = VK_TRUE;
  for (size_t i = 0; i < COUNT(kFormats); ++i) {
    depth_format = kFormats[i].format;
    depth_aspects = VK_IMAGE_ASPECT_DEPTH_BIT;
    if (strstr(kFormats[i].name, "_S8")) depth_aspects |= VK_IMAGE_ASPECT_STENCIL_BIT;
    if (strcmp(kFormats[i].name, name) == 0) return 1;
  }
  return 0;
}

int main(int count, char** words) {
  if (count > 1 && !choose_format(words[1])) return 1;
  open_device();
  make_shared();
  // RenderDoc is used only if it is loaded already: it sees only devices that it saw being made.
  struct RenderDoc* renderdoc = NULL;
  void* library = dlopen("librenderdoc.so", RTLD_NOW | RTLD_NOLOAD);
  GetApi get_api = library ? (GetApi)dlsym(library, "RENDERDOC_GetAPI") : NULL;
  if (get_api && get_api(10401, &renderdoc) != 1) return 1;
  void* captured = *(void**)instance;  // by which RenderDoc knows the device
  if (renderdoc) renderdoc->start_frame_capture(captured, NULL);
  printf("{\"width\": %d, \"height\": %d, \"draws\": [", WIDTH, HEIGHT);
  for (size_t i = 0; i < COUNT(kDraws); ++i) {
    draw(&kDraws[i]);
    printf(i > 0 ? ",\n" : "\n");
    print_drawn(&kDraws[i]);
  }
  printf("]}\n");
  return renderdoc && renderdoc->end_frame_capture(captured, NULL) != 1;
}
