// The engine's scene and its frames, handed to the plugin.
#include "Example/PluginScene.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <utility>

namespace Fork
{

using namespace Lantern;

FError FPluginScene::Create(
    IRTModule& Module, const FForkInstance& Instance, const FForkDevice& Owner, const IRTVulkanRequirements& Requirements)
{
	FRTVulkanExternalDesc Desc;
	Desc.Instance = Instance.Instance;
	Desc.PhysicalDevice = Owner.Physical;
	Desc.Device = Owner.Device;
	Desc.Queue = Owner.Queue;
	Desc.QueueFamily = Owner.QueueFamily;
	Desc.Requirements = &Requirements;
	// The render thread and that of the RHI submit.
	Desc.LockQueue = [](void* User) { static_cast<std::mutex*>(User)->lock(); };
	Desc.UnlockQueue = [](void* User) { static_cast<std::mutex*>(User)->unlock(); };
	Desc.QueueUser = &Owner.QueueMutex;
	FError Error = ToError(Module.GetVulkan()->AdoptDevice(Desc, Device.ReleaseAndGetAddress()), "AdoptDevice");
	if (Error.empty()) { Error = ToError(Module.CreateRenderer(Device.Get(), {}, Renderer.ReleaseAndGetAddress()), "CreateRenderer"); }
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

/// The plugin reads positions and normals from an array each.
struct FBoxArrays
{
	explicit FBoxArrays(const FBoxMesh& Box)
	{
		for (const FVertex& Vertex : Box.Vertices)
		{
			Positions.push_back(Vertex.Position);
			Normals.push_back(Vertex.Normal);
		}
	}
	std::vector<glm::vec3> Positions, Normals;
};

} // namespace

FError FPluginScene::AddBoxMesh(bool bDeformable, ERTMeshHandle& Out)
{
	const FBoxMesh Box = MakeBoxMesh();
	const FBoxArrays Arrays(Box);
	FRTModuleMesh Mesh;
	Mesh.Name = bDeformable ? "DeformableBox" : "Box";
	Mesh.Positions = &Arrays.Positions[0].x;
	Mesh.Normals = &Arrays.Normals[0].x;
	Mesh.VertexCount = static_cast<uint32_t>(Arrays.Positions.size());
	Mesh.Indices = Box.Indices.data();
	Mesh.IndexCount = static_cast<uint32_t>(Box.Indices.size());
	Mesh.bDeformable = bDeformable;
	return ToError(Renderer->AddMesh(Mesh, &Out), "AddMesh");
}

FError FPluginScene::AddMaterials()
{
	FError Error = ToError(Renderer->AddMaterial({}, &Solid), "AddMaterial(solid)");
	if (Error.empty())
	{
		FRTModuleMaterial Material;
		Material.BaseColor[3] = 0.0f; // below the cutoff everywhere
		Material.bMasked = true;
		Error = ToError(Renderer->AddMaterial(Material, &CutOut), "AddMaterial(cut out)");
	}
	return Error;
}

FError FPluginScene::AddBox(const FBox& Box, ERTMeshHandle OwnMesh)
{
	FRTModuleObject Object;
	Object.Mesh = OwnMesh != ERTMeshHandle::None ? OwnMesh : Box.bDeformable ? DeformableMesh : RigidMesh;
	Object.Materials = Box.bCutOut ? &CutOut : &Solid;
	Object.MaterialCount = 1;
	Object.bCastsShadow = Box.bCastsShadow;
	const std::array<double, 12> Transform = GetTransform(Box);
	std::copy(Transform.begin(), Transform.end(), Object.Transform);
	Boxes.push_back({ERTObjectHandle::None, OwnMesh});
	return ToError(Renderer->AddObject(Object, &Boxes.back().Object), "AddObject");
}

namespace
{

std::vector<glm::vec3> SkinReed(const FReedMesh& Mesh, double Bend)
{
	std::vector<glm::vec3> Positions;
	for (const FSkinVertex& Vertex : Mesh.Vertices) { Positions.emplace_back(SkinVertex(Vertex, Bend)); }
	return Positions;
}

} // namespace

FError FPluginScene::AddReed(const FReed& At)
{
	const FReedMesh Source = MakeReedMesh();
	const std::vector<glm::vec3> Positions = SkinReed(Source, At.Bend);
	FRTModuleMesh Mesh;
	Mesh.Name = "Reed";
	Mesh.Positions = &Positions[0].x;
	Mesh.VertexCount = static_cast<uint32_t>(Positions.size());
	Mesh.Indices = Source.Indices.data();
	Mesh.IndexCount = static_cast<uint32_t>(Source.Indices.size());
	Mesh.bDeformable = true;
	Mesh.BoundsRadius = 2.2f; // however it bends
	if (FError Error = ToError(Renderer->AddMesh(Mesh, &ReedMesh), "AddMesh(reed)"); !Error.empty()) { return Error; }
	FRTModuleObject Object;
	Object.Mesh = ReedMesh;
	Object.Materials = &Solid;
	Object.MaterialCount = 1;
	for (int Axis = 0; Axis < 3; ++Axis) { Object.Transform[Axis * 4 + 3] = At.Middle[Axis]; }
	return ToError(Renderer->AddObject(Object, &Reed), "AddObject(reed)");
}

FError FPluginScene::FindReedPositions(VkDeviceAddress& Out)
{
	FRTModuleMeshBuffer Buffer;
	const FError Error = ToError(Renderer->GetMeshBuffer(ReedMesh, &Buffer), "GetMeshBuffer(reed)");
	Out = Error.empty() && Buffer.Buffer != nullptr ? Buffer.Buffer->GetDeviceAddress() + Buffer.PositionsOffset : 0;
	return Error;
}

FError FPluginScene::MarkReedSkinned() { return ToError(Renderer->MarkMeshDeformed(ReedMesh), "MarkMeshDeformed(reed)"); }

FError FPluginScene::AddScene(const FForkScene& Scene)
{
	FError Error = AddBoxMesh(false, RigidMesh);
	if (Error.empty()) { Error = AddBoxMesh(true, DeformableMesh); }
	if (Error.empty()) { Error = AddMaterials(); }
	for (size_t Index = 0; Error.empty() && Index < Scene.Boxes.size(); ++Index) { Error = AddBox(Scene.Boxes[Index]); }
	if (Error.empty()) { Error = AddReed(Scene.Reed); }
	FRTModuleSun Sun;
	Sun.Irradiance = 1.0f;
	for (int Axis = 0; Axis < 3; ++Axis) { Sun.Direction[Axis] = Scene.SunDirection[Axis]; }
	return Error.empty() ? ToError(Renderer->SetSun(Sun), "SetSun") : Error;
}

FError FPluginScene::MoveBox(size_t Box, const FBox& To)
{
	return ToError(Renderer->SetObjectTransform(Boxes[Box].Object, GetTransform(To).data()), "SetObjectTransform");
}

FError FPluginScene::StreamIn(const FBox& Box)
{
	ERTMeshHandle OwnMesh{};
	const FError Error = AddBoxMesh(false, OwnMesh);
	return Error.empty() ? AddBox(Box, OwnMesh) : Error;
}

FError FPluginScene::RemoveBox(size_t Box)
{
	FError Error = ToError(Renderer->RemoveObject(Boxes[Box].Object), "RemoveObject");
	const ERTMeshHandle OwnMesh = Boxes[Box].OwnMesh;
	if (Error.empty() && OwnMesh != ERTMeshHandle::None) { Error = ToError(Renderer->RemoveMesh(OwnMesh), "RemoveMesh"); }
	Boxes.erase(Boxes.begin() + static_cast<std::ptrdiff_t>(Box));
	return Error;
}

FError FPluginScene::ScaleVertices(float Scale)
{
	const FBoxArrays Arrays(MakeBoxMesh(glm::vec3(Scale)));
	return ToError(Renderer->UpdateMeshVertices(DeformableMesh, &Arrays.Positions[0].x, &Arrays.Normals[0].x), "UpdateMeshVertices");
}

FError FPluginScene::SetBox(size_t Box, const FBox& To)
{
	const FError Error = ToError(Renderer->SetObjectMaterials(Boxes[Box].Object, To.bCutOut ? &CutOut : &Solid, 1), "SetObjectMaterials");
	return Error.empty() ? ToError(Renderer->SetObjectCastsShadow(Boxes[Box].Object, To.bCastsShadow), "SetObjectCastsShadow") : Error;
}

FError FPluginScene::ImportGBuffer(const FForkRaster& Raster, VkExtent2D Size)
{
	FGBuffer& To = GBuffers.emplace_back();
	FRTTextureDesc Desc;
	Desc.Width = Size.width;
	Desc.Height = Size.height;
	Desc.Format = ERTFormat::D32_FLOAT_S8_UINT;
	Desc.Usage = ERTTextureUsage::Sampled;
	Desc.Name = "ForkDepth";
	const auto ToNative = [](VkImage Image) { return reinterpret_cast<uint64_t>(Image); };
	FError Error =
	    ToError(Device->ImportTexture(Desc, ToNative(Raster.Depth.Image), To.Depth.ReleaseAndGetAddress()), "ImportTexture(depth)");
	if (!Error.empty()) { return Error; }
	// The raster's barrier has already waited for the depth. The next frame's raster begins with a barrier of its own.
	const FRTExternalState State{FForkRaster::DepthLayout, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT};
	Error = ToError(To.Depth->SetExternalState(State, State), "SetExternalState(depth)");
	if (!Error.empty()) { return Error; }
	Desc.Format = ERTFormat::RGBA8_UNORM;
	Desc.Name = "ForkNormals";
	return ToError(
	    Device->ImportTexture(Desc, ToNative(Raster.Normals.Image), To.Normals.ReleaseAndGetAddress()), "ImportTexture(normals)");
}

void FPluginScene::ReleaseGBuffer()
{
	GBuffers.clear();
	if (Device) { Device->CollectGarbage(); } // destroys the plugin's views of the images now, not some time later
}

namespace
{

FRTModuleView MakeView(const FCamera& Camera, const FRTTextureDesc& Size)
{
	FRTModuleView View;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		View.Position[Axis] = Camera.Position[Axis];
		View.Forward[Axis] = static_cast<float>(Camera.Forward[Axis]);
		View.Up[Axis] = static_cast<float>(Camera.Up[Axis]);
	}
	const glm::mat4 Rows = transpose(GetViewToClip(Camera, double(Size.Width) / Size.Height));
	std::copy_n(&Rows[0][0], 16, View.Projection.ViewToClip);
	for (int Axis = 0; Axis < 2; ++Axis) { View.Jitter[Axis] = static_cast<float>(Camera.Jitter[Axis]); }
	return View;
}

} // namespace

FError FPluginScene::Render(VkCommandBuffer Commands, const FCamera& Camera, uint32_t View, bool bCut, FRTModuleOutputs& Out)
{
	Out = {};
	const uint64_t Native = reinterpret_cast<uint64_t>(Commands);
	FError Error = ToError(Device->ImportCommandList(Native, List.ReleaseAndGetAddress()), "ImportCommandList");
	if (!Error.empty()) { return Error; }
	const FGBuffer& GBuffer = GBuffers[View];
	FRTModuleFrame Frame;
	Frame.Commands = List.Get();
	Frame.View = MakeView(Camera, GBuffer.Depth->GetDesc());
	Frame.ViewIndex = View;
	Frame.Depth = GBuffer.Depth.Get();
	Frame.DepthAccess = ERTAccess::External;
	Frame.Normals = GBuffer.Normals.Get();
	Frame.Layout.Normals = ERTModuleNormals::Xyz;
	Frame.Layout.bViewSpaceNormals = true;
	Frame.Layout.bGeometricInZw = false; // this engine has none: depth says where surfaces face
	const auto Now = std::chrono::steady_clock::now();
	if (View == 0)
	{
		const std::chrono::duration<float> Since = Now - std::exchange(LastFrame, Now);
		DeltaSeconds = std::clamp(Since.count(), 1e-4f, 1.0f); // the first frame has none before it
		bComplete = true;
	}
	Frame.DeltaSeconds = DeltaSeconds;
	Frame.bCut = bCut;
	Frame.Wanted.Add(ESignal::AmbientOcclusion);
	Error = ToError(Renderer->RenderFrame(Frame, &Out), "RenderFrame");
	bComplete = bComplete && Out.bComplete;
	return Error;
}

FError FPluginScene::FinishFrame()
{
	const FError Error = ToError(Renderer->EndFrame(nullptr), "EndFrame");
	List.Reset();
	return Error;
}

} // namespace Fork
