#include "PluginScene.h"

#include <algorithm>
#include <array>

namespace Fork
{

using namespace Lantern;

FError ToError(const FRTStatus& Status, const char* What)
{
	return Status.IsOk() ? FError() : FError(What) + ": " + Status.Message;
}

FError FPluginScene::Create(IRTModule& Module, const FForkInstance& Instance, const FForkDevice& Owner,
                            const IRTVulkanRequirements& Requirements)
{
	FRTVulkanExternalDesc Desc;
	Desc.Instance = Instance.Instance;
	Desc.PhysicalDevice = Owner.Physical;
	Desc.Device = Owner.Device;
	Desc.Queue = Owner.Queue;
	Desc.QueueFamily = Owner.QueueFamily;
	Desc.Requirements = &Requirements;
	FError Error = ToError(Module.GetVulkan()->AdoptDevice(Desc, Device.ReleaseAndGetAddress()), "AdoptDevice");
	if (Error.empty())
	{
		Error = ToError(Module.CreateRenderer(Device.Get(), Renderer.ReleaseAndGetAddress()), "CreateRenderer");
	}
	return Error;
}

namespace
{

std::array<double, 12> GetTransform(const FBox& Box)
{
	std::array<double, 12> Rows{};
	for (int Row = 0; Row < 3; ++Row)
	{
		Rows[static_cast<size_t>(Row * 5)] = Box.HalfSize[Row];
		Rows[static_cast<size_t>(Row * 4 + 3)] = Box.Centre[Row];
	}
	return Rows;
}

} // namespace

FError FPluginScene::AddScene(const FForkScene& Scene)
{
	// The plugin's arrays are of single numbers: positions apart from normals.
	const FBoxMesh Box = MakeBoxMesh();
	std::vector<glm::vec3> Positions, VertexNormals;
	for (const FVertex& Vertex : Box.Vertices)
	{
		Positions.push_back(Vertex.Position);
		VertexNormals.push_back(Vertex.Normal);
	}
	FRTModuleMesh Mesh;
	Mesh.Name = "Box";
	Mesh.Positions = &Positions[0].x;
	Mesh.Normals = &VertexNormals[0].x;
	Mesh.VertexCount = static_cast<uint32_t>(Positions.size());
	Mesh.Indices = Box.Indices.data();
	Mesh.IndexCount = static_cast<uint32_t>(Box.Indices.size());
	ERTMeshHandle MeshHandle = ERTMeshHandle::None;
	FError Error = ToError(Renderer->AddMesh(Mesh, &MeshHandle), "AddMesh");
	ERTMaterialHandle Material = ERTMaterialHandle::None;
	if (Error.empty())
	{
		Error = ToError(Renderer->AddMaterial({}, &Material), "AddMaterial");
	}
	for (size_t Index = 0; Error.empty() && Index < Scene.Boxes.size(); ++Index)
	{
		FRTModuleObject Object;
		Object.Mesh = MeshHandle;
		Object.Materials = &Material;
		Object.MaterialCount = 1;
		Object.bCastsShadow = Scene.Boxes[Index].bCastsShadow;
		const std::array<double, 12> Transform = GetTransform(Scene.Boxes[Index]);
		std::copy(Transform.begin(), Transform.end(), Object.Transform);
		Boxes.emplace_back();
		Error = ToError(Renderer->AddObject(Object, &Boxes.back()), "AddObject");
	}
	FRTModuleSun Sun;
	Sun.Irradiance = 1.0f;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		Sun.Direction[Axis] = Scene.SunDirection[Axis];
	}
	Renderer->SetSun(Sun);
	return Error;
}

void FPluginScene::MoveBox(size_t Box, const FBox& To)
{
	Renderer->SetObjectTransform(Boxes[Box], GetTransform(To).data());
}

void FPluginScene::RemoveBox(size_t Box)
{
	Renderer->RemoveObject(Boxes[Box]);
	Boxes.erase(Boxes.begin() + static_cast<std::ptrdiff_t>(Box));
}

FError FPluginScene::ImportGBuffer(const FForkRaster& Raster, VkExtent2D Size)
{
	FRTTextureDesc Desc;
	Desc.Width = Size.width;
	Desc.Height = Size.height;
	Desc.Format = ERTFormat::D32_FLOAT;
	Desc.Usage = ERTTextureUsage::Sampled;
	Desc.Name = "ForkDepth";
	const auto ToNative = [](VkImage Image) { return reinterpret_cast<uint64_t>(Image); };
	FError Error = ToError(Device->ImportTexture(Desc, ToNative(Raster.Depth.Image), Depth.ReleaseAndGetAddress()),
	                       "ImportTexture(depth)");
	if (Error.empty())
	{
		Desc.Format = ERTFormat::RGBA16_SNORM;
		Desc.Name = "ForkNormals";
		Error = ToError(Device->ImportTexture(Desc, ToNative(Raster.Normals.Image), Normals.ReleaseAndGetAddress()),
		                "ImportTexture(normals)");
	}
	return Error;
}

void FPluginScene::ReleaseGBuffer()
{
	Depth.Reset();
	Normals.Reset();
	Device->CollectGarbage(); // the views of the images go now, not some time later
}

FError FPluginScene::Render(VkCommandBuffer Commands, const FCamera& Camera, IRTTexture*& OutMask)
{
	OutMask = nullptr;
	const uint64_t Native = reinterpret_cast<uint64_t>(Commands);
	FError Error = ToError(Device->ImportCommandList(Native, List.ReleaseAndGetAddress()), "ImportCommandList");
	if (!Error.empty())
	{
		return Error;
	}
	FRTModuleFrame Frame;
	Frame.Commands = List.Get();
	Frame.Depth = Depth.Get();
	Frame.Normals = Normals.Get();
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		Frame.View.Position[Axis] = Camera.Position[Axis];
		Frame.View.Forward[Axis] = static_cast<float>(Camera.Forward[Axis]);
		Frame.View.Up[Axis] = static_cast<float>(Camera.Up[Axis]);
	}
	Frame.View.FovY = static_cast<float>(Camera.FovY);
	Frame.View.Near = static_cast<float>(Camera.Near);
	FRTModuleOutputs Outputs;
	Error = ToError(Renderer->RenderFrame(Frame, &Outputs), "RenderFrame");
	OutMask = Outputs.bComplete ? Outputs.SunShadow : nullptr;
	return Error;
}

FError FPluginScene::FinishFrame()
{
	const FError Error = ToError(Renderer->EndFrame(nullptr), "EndFrame");
	List.Reset();
	return Error;
}

} // namespace Fork
