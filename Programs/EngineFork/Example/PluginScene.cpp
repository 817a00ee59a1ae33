// The engine's scene and its frames, handed to the plugin.
#include "Example/PluginScene.h"

#include <algorithm>
#include <array>
#include <utility>

namespace Fork
{

using namespace Lantern;

FError FPluginScene::Create(IRTModule& Module, const FPluginDevice& InOn, const FForkScene& Scene)
{
	On = &InOn;
	// The axes of the engine's world in Lantern's, which is in metres with x right, y up, z towards the viewer.
	const FRTModuleRendererDesc World{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}, float(1.0 / Metre)};
	FError Error = ToError(Module.CreateRenderer(On->Device.Get(), World, Renderer.ReleaseAndGetAddress()), "CreateRenderer");
	if (Error.empty()) { Error = AddBoxMesh(false, RigidMesh); }
	if (Error.empty()) { Error = AddBoxMesh(true, DeformableMesh); }
	if (Error.empty()) { Error = AddMaterials(); }
	for (size_t Index = 0; Error.empty() && Index < Scene.Boxes.size(); ++Index) { Error = AddBox(Scene.Boxes[Index]); }
	if (Error.empty()) { Error = AddReed(Scene.Reed); }
	if (Error.empty()) { Error = AddProfile(); }
	FRTModuleSun Sun;
	Sun.Irradiance = 1.0f;
	for (int Axis = 0; Axis < 3; ++Axis) { Sun.Direction[Axis] = Scene.SunDirection[Axis]; }
	return Error.empty() ? ToError(Renderer->SetSun(Sun), "SetSun") : Error;
}

FError FPluginScene::Recreate(const FPluginDevice& InOn)
{
	List.Reset();
	const FRTModuleMeshSource Source{
	    [](void* User, ERTMeshHandle Mesh, FRTModuleMesh* Out) { return static_cast<FPluginScene*>(User)->GiveMesh(Mesh, Out); }, this};
	FError Error = ToError(Renderer->Recreate(InOn.Device.Get(), Source), "Recreate");
	if (!Error.empty()) { return Error; }
	On = &InOn;
	return ToError(Renderer->SetMaterial(CutOut, MakeCutOut()), "SetMaterial(cut out)"); // maps were on the old device
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

FError FPluginScene::AddBoxMesh(bool bDeformable, ERTMeshHandle& Out)
{
	const FMeshArrays Box(MakeBoxMesh());
	return ToError(Renderer->AddMesh(Box.Describe(bDeformable ? "DeformableBox" : "Box", bDeformable), &Out), "AddMesh");
}

/// Meshes are made, so they can be made again. Other engines keep them, or read their files.
bool FPluginScene::GiveMesh(ERTMeshHandle Mesh, FRTModuleMesh* Out)
{
	static const FMeshArrays Box(MakeBoxMesh()), Stem(MakeReedMesh()), Sheet = MakePaneArrays();
	if (Mesh == DeformableMesh)
	{
		Deformed = std::make_unique<FMeshArrays>(MakeBoxMesh(glm::vec3(VertexScale)));
		*Out = Deformed->Describe("DeformableBox", true);
	}
	else if (Mesh == PaneMesh) { *Out = Sheet.Describe("Pane", false); }
	else { *Out = Mesh == ReedMesh ? DescribeReed(Stem) : Box.Describe("Box", false); }
	return true;
}

FRTModuleMaterial FPluginScene::MakeCutOut() const
{
	FRTModuleMaterial Material;
	Material.BaseColorMap.Texture = On->CutOutMap.Get();
	Material.BaseColorMap.Sampler = On->CutOutSampler.Get();
	Material.bMasked = true;
	return Material;
}

FError FPluginScene::AddMaterials()
{
	FRTModuleMaterial Clear;
	Clear.Transmission = 1.0f;
	Clear.Roughness = 0.0f;
	Clear.bDoubleSided = true;
	FError Error = ToError(Renderer->AddMaterial({}, &Solid), "AddMaterial(solid)");
	if (Error.empty()) { Error = ToError(Renderer->AddMaterial(Clear, &Glass), "AddMaterial(glass)"); }
	return Error.empty() ? ToError(Renderer->AddMaterial(MakeCutOut(), &CutOut), "AddMaterial(cut out)") : Error;
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

FError FPluginScene::AddReed(const FReed& At)
{
	const FMeshArrays Stem(MakeReedMesh());
	if (FError Error = ToError(Renderer->AddMesh(DescribeReed(Stem), &ReedMesh), "AddMesh(reed)"); !Error.empty()) { return Error; }
	FRTModuleObject Object;
	Object.Mesh = ReedMesh;
	Object.Materials = &Solid;
	Object.MaterialCount = 1;
	for (int Axis = 0; Axis < 3; ++Axis) { Object.Transform[Axis * 4 + 3] = At.Middle[Axis]; }
	return ToError(Renderer->AddObject(Object, &Reed), "AddObject(reed)");
}

FError FPluginScene::SetPane(const FForkScene& Scene)
{
	if (!Scene.Pane) { return ToError(Renderer->RemoveObject(std::exchange(Pane, ERTObjectHandle::None)), "RemoveObject(pane)"); }
	const FMeshArrays Sheet = MakePaneArrays();
	FError Error;
	if (PaneMesh == ERTMeshHandle::None) { Error = ToError(Renderer->AddMesh(Sheet.Describe("Pane", false), &PaneMesh), "AddMesh(pane)"); }
	FRTModuleObject Object;
	Object.Mesh = PaneMesh;
	Object.Materials = &Glass;
	Object.MaterialCount = 1;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		Object.Transform[Axis * 5] = Axis == 2 ? 1.0 : Scene.Pane->HalfSize;
		Object.Transform[Axis * 4 + 3] = Scene.Pane->Centre[Axis];
	}
	return Error.empty() ? ToError(Renderer->AddObject(Object, &Pane), "AddObject(pane)") : Error;
}

FError FPluginScene::FindReedPositions(VkDeviceAddress& Out)
{
	FRTModuleMeshBuffer Buffer;
	const FError Error = ToError(Renderer->GetMeshBuffer(ReedMesh, &Buffer), "GetMeshBuffer(reed)");
	Out = Error.empty() && Buffer.Buffer != nullptr ? Buffer.Buffer->GetDeviceAddress() + Buffer.PositionsOffset : 0;
	return Error;
}

FError FPluginScene::MarkReedSkinned() { return ToError(Renderer->MarkMeshDeformed(ReedMesh), "MarkMeshDeformed(reed)"); }

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
	VertexScale = Scale;
	const FMeshArrays Box(MakeBoxMesh(glm::vec3(Scale)));
	return ToError(Renderer->UpdateMeshVertices(DeformableMesh, &Box.Positions[0].x, &Box.Normals[0].x), "UpdateMeshVertices");
}

FError FPluginScene::SetBox(size_t Box, const FBox& To)
{
	const FError Error = ToError(Renderer->SetObjectMaterials(Boxes[Box].Object, To.bCutOut ? &CutOut : &Solid, 1), "SetObjectMaterials");
	return Error.empty() ? ToError(Renderer->SetObjectCastsShadow(Boxes[Box].Object, To.bCastsShadow), "SetObjectCastsShadow") : Error;
}

/// A file of IES LM-63, as an engine would have it from a maker of lamps.
FError FPluginScene::AddProfile()
{
	static constexpr char File[] = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 4 1 1 2 0 0 0\n1 1 10\n0 150 170 180\n0\n100 100 200 200\n";
	FRTModuleIesProfile Given;
	Given.Name = "lamp.ies";
	Given.Text = File;
	Given.TextBytes = sizeof(File) - 1;
	return ToError(Renderer->AddIesProfile(Given, &Profile, nullptr), "AddIesProfile");
}

FError FPluginScene::SetLamp(const FForkScene& Scene)
{
	if (Scene.LampIntensity <= 0.0) { return ToError(Renderer->RemoveLight(std::exchange(Lamp, ERTLightHandle::None)), "RemoveLight"); }
	FRTModuleLight Light;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		Light.Position[Axis] = Scene.Lamp[Axis];
		Light.Color[Axis] = static_cast<float>(Scene.LampIntensity);
		Light.Direction[Axis] = Axis == 2 ? -1.0f : 0.0f;
	}
	Light.Channels = Scene.LampChannels;
	if (Scene.bLampProfile) { Light.Ies = Profile; }
	if (Scene.LampWidth > 0.0)
	{
		Light.Type = ERTModuleLight::Rectangle;
		Light.Width = Light.Height = static_cast<float>(Scene.LampWidth);
		const double Area = Scene.LampWidth * Scene.LampWidth / (Metre * Metre);
		for (float& Color : Light.Color) { Color = static_cast<float>(Scene.LampIntensity / Area); } // nits
	}
	return ToError(Lamp == ERTLightHandle::None ? Renderer->AddLight(Light, &Lamp) : Renderer->SetLight(Lamp, Light), "AddLight");
}

namespace
{

FRTModuleView MakeView(const FCamera& Camera)
{
	FRTModuleView View;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		View.Position[Axis] = Camera.Position[Axis];
		View.Forward[Axis] = static_cast<float>(Camera.Forward[Axis]);
		View.Up[Axis] = static_cast<float>(Camera.Up[Axis]);
	}
	const glm::mat4 Rows = transpose(GetViewToClip(Camera, double(ViewSize.width) / ViewSize.height));
	std::copy_n(&Rows[0][0], 16, View.Projection.ViewToClip);
	for (int Axis = 0; Axis < 2; ++Axis) { View.Jitter[Axis] = static_cast<float>(Camera.Jitter[Axis]); }
	return View;
}

} // namespace

FError FPluginScene::Render(VkCommandBuffer Commands, const FForkFrame& From, bool bCut, FRTModuleOutputs& Out)
{
	Out = {};
	const uint64_t Native = reinterpret_cast<uint64_t>(Commands);
	FError Error = ToError(On->Device->ImportCommandList(Native, List.ReleaseAndGetAddress()), "ImportCommandList");
	if (!Error.empty()) { return Error; }
	FRTModuleFrame Frame;
	Frame.Commands = List.Get();
	Frame.View = MakeView(From.Scene.Cameras[From.View]);
	Frame.ViewIndex = From.View;
	Frame.OffsetX = static_cast<uint32_t>(GetViewOffset(From.View).x);
	Frame.Width = ViewSize.width;
	Frame.Height = ViewSize.height;
	Frame.Depth = On->Depth.Get();
	Frame.DepthAccess = ERTAccess::External;
	Frame.Normals = On->Normals.Get();
	Frame.Layout.Normals = ERTModuleNormals::Xyz;
	Frame.Layout.bViewSpaceNormals = true;
	Frame.Layout.bGeometricInZw = false; // this engine has none: depth says where surfaces face
	Frame.Motion = On->Motion.Get();
	Frame.BaseColor = On->BaseColor.Get();
	Frame.Material = On->Material.Get();
	Frame.Layout.Motion = ERTModuleMotion::UV;
	Frame.Layout.MotionScale[0] = Frame.Layout.MotionScale[1] = -1.0f; // this engine's leads to this frame, not to the one before
	if (From.View == 0) { bComplete = true; }
	Frame.DeltaSeconds = FrameSeconds;
	Frame.bCut = bCut;
	// The first view's commands have the reed's skinning, and are not submitted yet.
	Frame.bSubmitAhead = From.View != 0;
	Frame.Wanted = Wanted;
	Frame.bLightMask = bLightMask;
	Frame.bTransmission = From.Scene.Pane.has_value();
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
