static void check_vk(VkResult result, const char *what) {
  if (result == VK_SUCCESS) return;
  fprintf(stderr, "VkResult %d: ", result);
  give_up(what);
}

static VkPhysicalDevice physical;
static VkDevice device;
static VkQueue queue;
static uint32_t queue_family;

/* Chooses the first device whose name contains `name`. */
static VkPhysicalDeviceProperties choose_device(const char *name) {
  const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                         .apiVersion = VK_API_VERSION_1_3};
  const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                     .pApplicationInfo = &application};
  VkInstance instance;
  check_vk(vkCreateInstance(&info, NULL, &instance), "no Vulkan instance");
  VkPhysicalDevice all[16];
  uint32_t count = 16;
  vkEnumeratePhysicalDevices(instance, &count, all);
  VkPhysicalDeviceProperties about;
  for (uint32_t i = 0; i < count; ++i) {
    physical = all[i];
    vkGetPhysicalDeviceProperties(physical, &about);
    if (strstr(about.deviceName, name)) return about;
    fprintf(stderr, "not chosen: %s\n", about.deviceName);
  }
  give_up("no such device");
  return about;
}

/* The test means nothing on a device that lacks any of this. */
static void check_limits(const VkPhysicalDeviceProperties *about,
                         const VkPhysicalDeviceFeatures *features) {
  const VkPhysicalDeviceLimits *limits = &about->limits;
  if (about->apiVersion < VK_API_VERSION_1_3) give_up("the device has no Vulkan 1.3");
  if (!features->fragmentStoresAndAtomics) give_up("no fragmentStoresAndAtomics");
  if (!(limits->framebufferColorSampleCounts & SAMPLES)) give_up("not so many samples");
  if (SAMPLES > 1 && !features->sampleRateShading) give_up("no sampleRateShading");
  if (SAMPLES > 1 && !limits->standardSampleLocations) {
    give_up("samples are not at the standard positions");
  }
  if (CLAMPS_DEPTH && !features->depthClamp) give_up("no depthClamp");
  if (CLIP_DISTANCES > 0 &&
      (!features->shaderClipDistance || (int)limits->maxClipDistances < CLIP_DISTANCES)) {
    give_up("not so many clip distances");
  }
  /* Each attribute has a location, of four components, to itself. */
  if ((int)limits->maxVertexOutputComponents < 4 * ATTRIBUTES ||
      (int)limits->maxFragmentInputComponents < 4 * ATTRIBUTES) {
    give_up("not so many attributes");
  }
  for (int axis = 0; axis < 2; ++axis) {
    const float end = viewport[axis] + viewport[2 + axis];
    if (viewport[axis] < limits->viewportBoundsRange[0] || end > limits->viewportBoundsRange[1]) {
      give_up("not so large a viewport");
    }
  }
  check_grid((int)limits->subPixelPrecisionBits);
}

static void open_device(const char *name) {
  const VkPhysicalDeviceProperties about = choose_device(name);
  printf("%s, driver %u, Vulkan %u.%u\n", about.deviceName, about.driverVersion,
         VK_API_VERSION_MAJOR(about.apiVersion), VK_API_VERSION_MINOR(about.apiVersion));
  VkPhysicalDeviceFeatures features;
  vkGetPhysicalDeviceFeatures(physical, &features);
  features.robustBufferAccess = VK_FALSE;
  check_limits(&about, &features);

  VkQueueFamilyProperties families[16];
  uint32_t count = 16;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
  while (queue_family < count && !(families[queue_family].queueFlags & VK_QUEUE_GRAPHICS_BIT)) {
    ++queue_family;
  }
  if (queue_family == count) give_up("no queue for graphics");
  const float priority = 1;
  const VkDeviceQueueCreateInfo queue_info = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                              .queueFamilyIndex = queue_family,
                                              .queueCount = 1,
                                              .pQueuePriorities = &priority};
  const VkPhysicalDeviceVulkan13Features features_1_3 = {
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, .dynamicRendering = VK_TRUE};
  const VkDeviceCreateInfo device_info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                          .pNext = &features_1_3,
                                          .queueCreateInfoCount = 1,
                                          .pQueueCreateInfos = &queue_info,
                                          .pEnabledFeatures = &features};
  check_vk(vkCreateDevice(physical, &device_info, NULL, &device), "no Vulkan device");
  vkGetDeviceQueue(device, queue_family, 0, &queue);
}

static VkDeviceMemory allocate(VkMemoryRequirements needs, VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties memories;
  vkGetPhysicalDeviceMemoryProperties(physical, &memories);
  uint32_t type = 0;
  while (type < memories.memoryTypeCount &&
         (!(needs.memoryTypeBits >> type & 1) ||
          (memories.memoryTypes[type].propertyFlags & flags) != flags)) {
    ++type;
  }
  if (type == memories.memoryTypeCount) give_up("no memory of the kind that is needed");
  const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                     .allocationSize = needs.size,
                                     .memoryTypeIndex = type};
  VkDeviceMemory memory;
  check_vk(vkAllocateMemory(device, &info, NULL, &memory), "no memory");
  return memory;
}

/* A buffer that the host sees at *mapped. */
static VkBuffer make_buffer(VkDeviceSize size, VkBufferUsageFlags usage, void **mapped) {
  const VkBufferCreateInfo info = {
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
  VkBuffer buffer;
  check_vk(vkCreateBuffer(device, &info, NULL, &buffer), "no buffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, buffer, &needs);
  const VkDeviceMemory memory = allocate(
      needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check_vk(vkBindBufferMemory(device, buffer, memory, 0), "no memory for a buffer");
  check_vk(vkMapMemory(device, memory, 0, size, 0, mapped), "a buffer cannot be mapped");
  return buffer;
}

/* Nothing is written to the target; it gives the fragments their samples. */
static VkImageView make_target(VkImage *image) {
  const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                  .imageType = VK_IMAGE_TYPE_2D,
                                  .format = VK_FORMAT_R8G8B8A8_UNORM,
                                  .extent = {WIDTH, HEIGHT, 1},
                                  .mipLevels = 1,
                                  .arrayLayers = 1,
                                  .samples = (VkSampleCountFlagBits)SAMPLES,
                                  .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
  check_vk(vkCreateImage(device, &info, NULL, image), "no image");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, *image, &needs);
  check_vk(vkBindImageMemory(device, *image, allocate(needs, 0), 0), "no memory for an image");
  const VkImageViewCreateInfo view_info = {
      .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
      .image = *image,
      .viewType = VK_IMAGE_VIEW_TYPE_2D,
      .format = info.format,
      .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
  VkImageView view;
  check_vk(vkCreateImageView(device, &view_info, NULL, &view), "no image view");
  return view;
}

/* Has glslangValidator compile the shader, in files that are this process's own. */
static VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits which, const char *ending,
                                             const char *text) {
  static uint32_t code[1 << 18];
  char source[100], compiled[110], command[300];
  snprintf(source, sizeof source, "case-%ld.%s", (long)getpid(), ending);
  snprintf(compiled, sizeof compiled, "%s.spv", source);
  snprintf(command, sizeof command, "glslangValidator -V -o %s %s >/dev/null", compiled, source);
  FILE *out = fopen(source, "w");
  if (!out || fputs(text, out) < 0 || fclose(out) != 0) give_up("a shader cannot be written");
  if (system(command) != 0) give_up("glslangValidator fails on a shader");
  FILE *in = fopen(compiled, "rb");
  if (!in) give_up("a compiled shader cannot be read");
  const size_t size = fread(code, 1, sizeof code, in);
  if (size == sizeof code) give_up("a compiled shader is too long");
  fclose(in);
  remove(source);
  remove(compiled);
  const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                         .codeSize = size,
                                         .pCode = code};
  VkShaderModule module;
  check_vk(vkCreateShaderModule(device, &info, NULL, &module), "no shader module");
  return (VkPipelineShaderStageCreateInfo){
      .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
      .stage = which,
      .module = module,
      .pName = "main"};
}

static VkPipeline make_pipeline(VkPipelineLayout layout) {
  const VkPipelineShaderStageCreateInfo stages[] = {
      stage(VK_SHADER_STAGE_VERTEX_BIT, "vert", vertex_shader),
      stage(VK_SHADER_STAGE_FRAGMENT_BIT, "frag", fragment_shader)};
  const VkVertexInputBindingDescription binding = {0, VECTORS * 16, VK_VERTEX_INPUT_RATE_VERTEX};
  VkVertexInputAttributeDescription vectors[VECTORS];
  for (uint32_t i = 0; i < VECTORS; ++i) {
    vectors[i] =
        (VkVertexInputAttributeDescription){i, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 16 * i};
  }
  const VkPipelineVertexInputStateCreateInfo input = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
      .vertexBindingDescriptionCount = 1,
      .pVertexBindingDescriptions = &binding,
      .vertexAttributeDescriptionCount = VECTORS,
      .pVertexAttributeDescriptions = vectors};
  const VkPipelineInputAssemblyStateCreateInfo assembly = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
      .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  const VkViewport view = {viewport[0], viewport[1], viewport[2],
                           viewport[3], viewport[4], viewport[5]};
  const VkRect2D shown = {{scissor[0], scissor[1]}, {(uint32_t)scissor[2], (uint32_t)scissor[3]}};
  const VkPipelineViewportStateCreateInfo viewports = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
      .viewportCount = 1,
      .pViewports = &view,
      .scissorCount = 1,
      .pScissors = &shown};
  const VkPipelineRasterizationStateCreateInfo rasterization = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
      .depthClampEnable = CLAMPS_DEPTH,
      .cullMode = CULLS_FRONT  ? VK_CULL_MODE_FRONT_BIT
                  : CULLS_BACK ? VK_CULL_MODE_BACK_BIT
                               : VK_CULL_MODE_NONE,
      .frontFace = IS_FRONT_CCW ? VK_FRONT_FACE_COUNTER_CLOCKWISE : VK_FRONT_FACE_CLOCKWISE,
      .lineWidth = 1};
  const VkPipelineMultisampleStateCreateInfo multisampling = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
      .rasterizationSamples = (VkSampleCountFlagBits)SAMPLES};
  const VkPipelineColorBlendAttachmentState writes_nothing = {.colorWriteMask = 0};
  const VkPipelineColorBlendStateCreateInfo blending = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
      .attachmentCount = 1,
      .pAttachments = &writes_nothing};
  const VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
  const VkPipelineRenderingCreateInfo rendering = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
      .colorAttachmentCount = 1,
      .pColorAttachmentFormats = &format};
  const VkGraphicsPipelineCreateInfo info = {
      .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
      .pNext = &rendering,
      .stageCount = 2,
      .pStages = stages,
      .pVertexInputState = &input,
      .pInputAssemblyState = &assembly,
      .pViewportState = &viewports,
      .pRasterizationState = &rasterization,
      .pMultisampleState = &multisampling,
      .pColorBlendState = &blending,
      .layout = layout};
  VkPipeline pipeline;
  check_vk(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline),
           "no pipeline");
  return pipeline;
}

/* Returns a descriptor set for the buffer of records; stores its pipeline layout in *layout. */
static VkDescriptorSet name_records(VkBuffer records, VkPipelineLayout *layout) {
  const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                                                VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
  const VkDescriptorSetLayoutCreateInfo set_info = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
      .bindingCount = 1,
      .pBindings = &binding};
  VkDescriptorSetLayout set_layout;
  check_vk(vkCreateDescriptorSetLayout(device, &set_info, NULL, &set_layout), "no set layout");
  const VkPipelineLayoutCreateInfo layout_info = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
      .setLayoutCount = 1,
      .pSetLayouts = &set_layout};
  check_vk(vkCreatePipelineLayout(device, &layout_info, NULL, layout), "no pipeline layout");
  const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
  const VkDescriptorPoolCreateInfo pool_info = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
      .maxSets = 1,
      .poolSizeCount = 1,
      .pPoolSizes = &size};
  VkDescriptorPool pool;
  check_vk(vkCreateDescriptorPool(device, &pool_info, NULL, &pool), "no descriptor pool");
  const VkDescriptorSetAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                            .descriptorPool = pool,
                                            .descriptorSetCount = 1,
                                            .pSetLayouts = &set_layout};
  VkDescriptorSet set;
  check_vk(vkAllocateDescriptorSets(device, &info, &set), "no descriptor set");
  const VkDescriptorBufferInfo all = {records, 0, VK_WHOLE_SIZE};
  const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                      .dstSet = set,
                                      .descriptorCount = 1,
                                      .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                      .pBufferInfo = &all};
  vkUpdateDescriptorSets(device, 1, &write, 0, NULL);
  return set;
}

/* Begins rendering to the target, whose content is discarded. */
static void begin_drawing(VkCommandBuffer commands, VkImage image, VkImageView view) {
  const VkImageMemoryBarrier barrier = {
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
      .dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
      .newLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image,
      .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                       VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, 0, 0, NULL, 0, NULL, 1,
                       &barrier);
  const VkRenderingAttachmentInfo target = {
      .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
      .imageView = view,
      .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
      .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
      .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE};
  const VkRenderingInfo rendering = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                     .renderArea = {{0, 0}, {WIDTH, HEIGHT}},
                                     .layerCount = 1,
                                     .colorAttachmentCount = 1,
                                     .pColorAttachments = &target};
  vkCmdBeginRendering(commands, &rendering);
}

static void end_drawing(VkCommandBuffer commands) {
  vkCmdEndRendering(commands);
  const VkMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                   .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT,
                                   .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                       0, 1, &barrier, 0, NULL, 0, NULL);
  check_vk(vkEndCommandBuffer(commands), "the commands are refused");
  const VkSubmitInfo submission = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                   .commandBufferCount = 1,
                                   .pCommandBuffers = &commands};
  check_vk(vkQueueSubmit(queue, 1, &submission, VK_NULL_HANDLE), "drawing failed");
  check_vk(vkQueueWaitIdle(queue), "drawing failed");
}

int main(int argc, char **argv) {
  open_device(argc > 1 ? argv[1] : "");
  void *numbers, *records;
  const VkBuffer vertex_buffer =
      make_buffer(sizeof vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &numbers);
  memcpy(numbers, vertices, sizeof vertices);
  const VkBuffer record_buffer =
      make_buffer(RECORDS * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &records);
  VkImage image;
  const VkImageView view = make_target(&image);
  VkPipelineLayout layout;
  const VkDescriptorSet set = name_records(record_buffer, &layout);
  const VkPipeline pipeline = make_pipeline(layout);

  const VkCommandPoolCreateInfo pool_info = {
      .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
      .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
      .queueFamilyIndex = queue_family};
  VkCommandPool pool;
  check_vk(vkCreateCommandPool(device, &pool_info, NULL, &pool), "no command pool");
  const VkCommandBufferAllocateInfo commands_info = {
      .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
      .commandPool = pool,
      .commandBufferCount = 1};
  VkCommandBuffer commands;
  check_vk(vkAllocateCommandBuffers(device, &commands_info, &commands), "no command buffer");

  int faults = 0;
  for (uint32_t triangle = FIRST_TRIANGLE; triangle < END_TRIANGLE; ++triangle) {
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    const VkDeviceSize start = 0;
    memset(records, 0, RECORDS * sizeof(uint32_t));
    check_vk(vkBeginCommandBuffer(commands, &begin), "no commands");
    begin_drawing(commands, image, view);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, NULL);
    vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &start);
    vkCmdDraw(commands, 3, 1, 3 * triangle, 0);
    end_drawing(commands);
    faults += check((int)triangle, records);
  }
  printf(faults == 0 ? "all right\n" : "%d faults\n", faults);
  return faults != 0;
}
