from viscofric.literature.citations import Citations as Citations
