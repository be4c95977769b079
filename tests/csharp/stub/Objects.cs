// SPDX-License-Identifier: MIT
// As much of Godot's C# interface as the addon's classes use, after Godot 4.3's public signatures. It has no engine: objects remember
// what was asked of them, for the claims to look at.
using System;
using System.Collections.Generic;

namespace Godot
{
	public enum Error : long { Ok = 0, Failed = 1, InvalidData = 30 }

	public class GodotObject : IDisposable
	{
		public string ClassName = "Object";
		public readonly List<string> Asked = new List<string>();
		public readonly Dictionary<string, Variant> Values = new Dictionary<string, Variant>();
		public readonly List<KeyValuePair<string, Delegate>> Connected = new List<KeyValuePair<string, Delegate>>();
		public Variant[] LastArguments;
		public Variant Answer;
		public bool IsFreed;
		public static readonly List<GodotObject> All = new List<GodotObject>();

		public GodotObject() { All.Add(this); }
		public Variant Get(StringName property) { Asked.Add("get " + property); Variant value; return Values.TryGetValue(property.ToString(), out value) ? value : Answer; }
		public void Set(StringName property, Variant value) { Asked.Add("set " + property); Values[property.ToString()] = value; }
		public Variant Call(StringName method, params Variant[] args) { Asked.Add("call " + method); LastArguments = args; return Answer; }
		public Error Connect(StringName signal, Callable callable, uint flags = 0) { Connected.Add(new KeyValuePair<string, Delegate>(signal.ToString(), callable.Delegate)); return Error.Ok; }
		public void Disconnect(StringName signal, Callable callable) { Connected.Remove(new KeyValuePair<string, Delegate>(signal.ToString(), callable.Delegate)); }
		public bool IsClass(string name)
		{
			string parent;
			return name == ClassName || (ClassDB.Parents.TryGetValue(ClassName, out parent) && parent == name);
		}

		public string GetClass() { return ClassName; }
		public void Free() { IsFreed = true; }
		public void Dispose() { IsFreed = true; }
	}

	public class RefCounted : GodotObject { }
	public class Resource : RefCounted { }
	public class Curve : Resource { }

	public class Texture2D : Resource { }
	public class PhysicsMaterial : Resource { }
	public class World2D : Resource { public Rid Space; }
	public class PhysicsShapeQueryParameters2D : RefCounted { }
	public class InputEvent : Resource { }

	public class Node : GodotObject
	{
		public readonly List<Node> Children = new List<Node>();
		public Node GetNode(NodePath path) { return Children.Find(child => child.Name == path.ToString()); }
		public T GetNode<T>(NodePath path) where T : class { return GetNode(path) as T; }
		public void QueueFree() { IsFreed = true; }
		public void AddChild(Node node, bool forceReadableName = false, long @internal = 0) { Children.Add(node); }
		public string Name;
		public virtual void _Ready() { }
		public virtual void _Process(double delta) { }
		public virtual void _PhysicsProcess(double delta) { }
		public virtual void _UnhandledInput(InputEvent @event) { }
	}

	public class CanvasItem : Node
	{
		public Color Modulate { get; set; }
		public World2D GetWorld2D() { return new World2D(); }
	}

	public class Node2D : CanvasItem
	{
		public Vector2 Position { get; set; }
		public Vector2 GlobalPosition { get; set; }
	}

	public class CollisionObject2D : Node2D { }
	public class Area2D : CollisionObject2D { }
	public class Polygon2D : Node2D { }

	public static class ClassDB
	{
		/// What classes are known, and by which class of C#.
		public static readonly Dictionary<string, Func<GodotObject>> Known = new Dictionary<string, Func<GodotObject>>();

		/// Of a class that descends from another of the library, that one.
		public static readonly Dictionary<string, string> Parents = new Dictionary<string, string>();

		public static Variant Instantiate(StringName @class)
		{
			Func<GodotObject> make;
			if (!Known.TryGetValue(@class.ToString(), out make))
			{
				return new Variant();
			}
			GodotObject made = make();
			made.ClassName = @class.ToString();
			return made;
		}
	}

	public static class Engine
	{
		public static readonly Dictionary<string, GodotObject> Singletons = new Dictionary<string, GodotObject>();

		public static bool HasSingleton(StringName name) { return Singletons.ContainsKey(name.ToString()); }
		public static GodotObject GetSingleton(StringName name) { return Singletons[name.ToString()]; }
	}

	public static class GD
	{
		public static void Print(params object[] what) { Console.WriteLine(string.Concat(what)); }
	}
}
